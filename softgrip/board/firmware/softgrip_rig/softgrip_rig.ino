// The board of the rig: a syringe pump that is safe whatever its host does. See README.md.
#include <avr/sleep.h>
#include <util/atomic.h>

#include "commands.h"
#include "converter.h"
#include "framing.h"
#include "interlocks.h"
#include "motion.h"
#include "pins.h"
#include "reset.h"
#include "state.h"
#include "telemetry.h"
#include "uart.h"

uint16_t flags;
SetLimits limits = AT_START;

void setup() {
  DDRH |= VENT_OUT;
  motion::begin();
  uart::begin();
  converter::begin();
  set_sleep_mode(SLEEP_MODE_IDLE);
  reset::begin();
}

void tick() {
  reset::alive();
  interlocks::tick();
  motion::tick();
  telemetry::tick();
}

void loop() {
  framing::Frame frame;
  // A flood of bytes must not keep the safety checks waiting.
  while (uart::waiting() && !converter::sampled) {
    if (framing::receive(uart::take(), frame)) commands::handle(frame);
  }
  if (converter::sampled) {
    converter::sampled = false;
    tick();
  }
  cli();
  if (!uart::waiting() && !converter::sampled) {
    sleep_enable();
    sei();
    sleep_cpu();
    sleep_disable();
  }
  sei();
}
