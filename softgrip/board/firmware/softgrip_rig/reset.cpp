#include "reset.h"

#include <avr/io.h>
#include <avr/wdt.h>

namespace reset {

uint8_t cause __attribute__((section(".noinit")));

// Before main: the watchdog stays on after its own reset, and would strike again during start-up.
void early() __attribute__((naked, used, section(".init3")));
void early() {
  cause = MCUSR;
  MCUSR = 0;
  wdt_disable();
}

void begin() { wdt_enable(WDTO_250MS); }

void alive() { wdt_reset(); }

}
