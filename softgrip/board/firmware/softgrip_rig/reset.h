// Why the board started, and the watchdog that starts it again.
#pragma once
#include <stdint.h>

namespace reset {
extern uint8_t cause;  // bits of MCUSR
void begin();          // starts the watchdog, 250 ms
void alive();
}
