// The line to the host: two rings, never waited for.
#pragma once
#include <stdint.h>

namespace uart {
void begin();
bool waiting();
uint8_t take();
bool send(const uint8_t* data, uint8_t size);  // all of it or nothing
}
