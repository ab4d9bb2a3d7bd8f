#include <brume/brume.h>
#include <brume/brume_media.h>
#include <brume/brume_plugin.h>
