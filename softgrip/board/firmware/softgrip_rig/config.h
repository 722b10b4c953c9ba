// Made from softgrip/board/firmware/config.py by: python -m softgrip.board.firmware.header
// Do not edit.
#pragma once
#include "protocol.h"

#ifndef SET_UP
#define SET_UP SetUp_GRIPPER
#endif
#ifndef VALVE
#define VALVE 0
#endif

const bool HAS_PUMP = SET_UP == SetUp_GRIPPER;
const bool HAS_VALVE = VALVE;

const SetLimits HARD = {547, 12000, 4000, 40000, 200};  // 300 kPa, 120 mm, 5 rev/s, 50 rev/s², 200 ms
const SetLimits LEAST = {110, 0, 1, 100, 20};  // 5 kPa, 0 mm, 0.00125 rev/s, 0.125 rev/s², 20 ms
const SetLimits AT_START = {399, 9000, 4000, 40000, 200};  // 200 kPa, 90 mm, 5 rev/s, 50 rev/s², 200 ms

const uint16_t STEPS_PER_REVOLUTION = 800;  // of the motor as its driver steps it
const uint16_t PRESSURE_LOW = 51;  // count: below, the wire is broken or shorted
const uint16_t PRESSURE_HIGH = 972;  // count: above, likewise
const uint16_t PRESSURE_RELEASE = 8;  // counts below the limit, to push again
const int32_t STUCK_STEPS = 400;  // that must change the pressure by STUCK_COUNTS:
const uint16_t STUCK_COUNTS = 2;  // else the sensor is stuck or its tube is off
const int32_t HOMING_SPEED = 102400;  // 400 step/s
const int32_t LEAVING_STEPS = 400;  // to leave the switch when homing starts on it
const int32_t SWITCH_STEPS = 400;  // from home, where it may still be pressed
