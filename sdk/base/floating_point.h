#pragma once
#include <cfenv>

namespace brume {

// The default floating-point environment while it lives. Hosts flush denormals to zero, round otherwise or trap in their
// threads, and TBB's workers keep the mode of whichever thread first gave them work: results would depend on both.
class DefaultFloatingPoint {
public:
    DefaultFloatingPoint()
    {
        std::fegetenv(&callers_);
        std::fesetenv(FE_DFL_ENV);
    }
    ~DefaultFloatingPoint() { std::fesetenv(&callers_); }
    DefaultFloatingPoint(const DefaultFloatingPoint &) = delete;
    DefaultFloatingPoint &operator=(const DefaultFloatingPoint &) = delete;

private:
    std::fenv_t callers_;
};

}  // namespace brume
