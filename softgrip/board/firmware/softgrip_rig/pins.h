// Pins of the Arduino MEGA 2560.
#pragma once
#include <avr/io.h>

const uint8_t STEP = _BV(PB5);    // 11, OC1A
const uint8_t DIR = _BV(PB6);     // 12, high into the syringe
const uint8_t SWITCH = _BV(PH5);  // 8, to ground and normally closed: high at home or broken
const uint8_t VENT_OUT = _BV(PH6);  // 9
