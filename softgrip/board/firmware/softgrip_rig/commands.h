// What the host asks for, and the answer.
#pragma once
#include "framing.h"

namespace commands {
extern uint8_t last;  // sequence number of the last command that was answered
void handle(const framing::Frame& frame);
}
