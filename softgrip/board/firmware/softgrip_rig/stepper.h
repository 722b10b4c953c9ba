// STEP pulses, made by timer 1 itself, so that their times are exact.
#pragma once
#include <stdint.h>

namespace stepper {
void begin();
// At 1/256 step/s, no further than to a position, and for a few steps only: a program that hangs
// does not ask again, and so stops the motor. Against the motion it stops, and turns when asked again.
void run(int32_t speed, int32_t end);
void stop();  // at once
int32_t position();
void set_position(int32_t position);
}
