// Made from softgrip/board/firmware/config.py by: python -m softgrip.board.firmware.header
// Do not edit.
#pragma once
#include <avr/io.h>

const uint8_t STEP = _BV(PB5);  // 11
const uint8_t DIR = _BV(PB6);  // 12
const uint8_t SWITCH = _BV(PH5);  // 8
const uint8_t VENT_OUT = _BV(PH6);  // 9
