// The motor's speed: ramps, the ends of the stroke, and homing.
#pragma once
#include <stdint.h>

namespace motion {
void begin();
uint8_t want(int32_t speed);  // 1/256 step/s; a Reason, or 0
uint8_t home();
void rest();                  // by a ramp
void halt();                  // at once
int32_t speed();
void tick();
}
