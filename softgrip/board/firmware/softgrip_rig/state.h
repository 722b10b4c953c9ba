// What the parts of the firmware know in common.
#pragma once
#include "config.h"

extern uint16_t flags;     // of Flag
extern SetLimits limits;   // in force

inline bool has(uint16_t some) { return flags & some; }
inline void set(uint16_t some, bool on) { flags = on ? flags | some : flags & ~some; }
