// What the board sees, 40 times a second.
#pragma once

namespace telemetry {
void tick();
}
