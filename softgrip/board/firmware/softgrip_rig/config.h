// What this rig is made of. The hard bounds hold whatever the host asks for.
#pragma once
#include "protocol.h"

#ifndef SET_UP
#define SET_UP SetUp_GRIPPER  // or SetUp_PAD: no pump, and so no motion
#endif
#ifndef VALVE
#define VALVE 0  // 1 if a valve on pin 9 vents the syringe
#endif

const bool HAS_PUMP = SET_UP == SetUp_GRIPPER;
const bool HAS_VALVE = VALVE;

// Motor: 200 steps a revolution, of which the driver makes quarters; 8 mm lead, 0.01 mm a step.
const uint16_t STEPS_PER_REVOLUTION = 800;

// A sensor of 0 to 80 psi gives 0.5 to 4.5 V of 5 V: 102.3 + 1.484 counts a kPa.
const SetLimits HARD = {
    547,    // 300 kPa
    12000,  // step: the stroke of 200 mL
    4000,   // step/s: 5 rev/s
    40000,  // step/s^2: 50 rev/s^2
    200,    // ms
};
const SetLimits LEAST = {110, 0, 1, 100, 20};
const SetLimits AT_START = {
    399,  // 200 kPa
    9000,  // step: the stroke of 60 mL
    4000, 40000, 200,
};

const uint16_t PRESSURE_LOW = 51;    // 0.25 V: below it the sensor's wire is broken or shorted
const uint16_t PRESSURE_HIGH = 972;  // 4.75 V
const uint16_t PRESSURE_RELEASE = 8;  // counts below the limit at which pushing is allowed again
// Air pressed by so many steps must change the pressure by so many counts (4 mm of a closed 60 mL
// syringe make 6 counts): else the sensor is stuck or its tube is off.
const int32_t STUCK_STEPS = 400;
const uint16_t STUCK_COUNTS = 2;

const int32_t HOMING_SPEED = 400L * SPEED_SCALE;
const int32_t LEAVING_STEPS = 400;  // to leave the switch when homing starts on it
const int32_t SWITCH_STEPS = 400;   // from home, where the switch may still be pressed
