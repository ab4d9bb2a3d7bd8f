#include <brume/brume.h>
#include <brume/brume_plugin.h>
