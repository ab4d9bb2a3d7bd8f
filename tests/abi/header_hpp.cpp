#include <brume/brume.hpp>
