#include <brume/brume.h>
#include <brume/brume.h>
#include <brume/brume_media.h>
#include <brume/brume_plugin.h>

typedef int brume_test_header_is_c;
