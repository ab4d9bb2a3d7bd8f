// Where the library has no OpenGL.
#include "effect.h"
#include "instance.h"

namespace openfx {

ofx::Status fog_textures(Instance &, Properties)
{
    return ofx::gl_render_failed;
}

ofx::Status attach_gl(ofx::EffectHandle)
{
    return ofx::failed;
}

ofx::Status detach_gl(ofx::EffectHandle)
{
    return ofx::ok;
}

}  // namespace openfx
