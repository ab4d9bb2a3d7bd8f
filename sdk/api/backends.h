#pragma once
#include <memory>

#include "plan/backend.h"

namespace brume {

// The backend asked for, of those that this build has; throws Error.
std::unique_ptr<Backend> make_backend(const brume_context_desc &desc, const Log &log);

}  // namespace brume
