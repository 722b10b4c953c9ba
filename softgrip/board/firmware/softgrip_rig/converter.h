// The clock of 1 kHz and the converter: each tick the pressure, then one of the other channels.
#pragma once
#include <stdint.h>

namespace converter {
extern volatile uint16_t counts[];  // read by `count`, whole
extern volatile bool sampled;       // there is a new pressure; whoever acts on it clears this
void begin();
uint32_t now();    // ticks since the reset
uint8_t phase();   // of the tick within a telemetry frame
uint16_t count(uint8_t channel);
}
