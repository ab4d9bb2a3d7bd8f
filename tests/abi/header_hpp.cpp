#include <brume/brume.hpp>
#include <brume/brume_media.hpp>
