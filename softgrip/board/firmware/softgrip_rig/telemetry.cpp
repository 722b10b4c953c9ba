#include "telemetry.h"

#include "commands.h"
#include "converter.h"
#include "framing.h"
#include "motion.h"
#include "state.h"
#include "stepper.h"

namespace telemetry {

static uint16_t number;

void tick() {
  // The tick after that of the last channel: all others are of this frame.
  if (converter::phase() != CHANNELS - 1) return;
  Telemetry frame;
  frame.number = number++;
  frame.time = converter::now();
  for (uint8_t k = 0; k < CHANNELS; ++k) frame.channels[k] = converter::count(k);
  frame.position = stepper::position();
  frame.speed = motion::speed();
  frame.flags = flags;
  frame.last = commands::last;
  framing::send(ID_TELEMETRY, uint8_t(frame.number), &frame, sizeof frame);
}

}
