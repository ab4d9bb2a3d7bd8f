#pragma once
#include <memory>

namespace brume {

struct Context;

// Measures what the passes of the effects' offers take on this device, and sets the context's rates.
void calibrate(const std::shared_ptr<Context> &context);

}  // namespace brume
