#include "passes.h"
namespace airlight {
brume_status plan_tables(const brume_services &, brume_host, const brume_plugin_scene &, State &) { return BRUME_OK; }
}
