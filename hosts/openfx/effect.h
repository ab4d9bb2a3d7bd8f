// The actions of the effect: descriptions, and one instance's frames.
#pragma once
#include "host.h"

namespace openfx {

ofx::Status describe(ofx::EffectHandle effect);
ofx::Status describe_in_context(ofx::EffectHandle effect, const std::string &context);
ofx::Status create_instance(ofx::EffectHandle effect);
ofx::Status destroy_instance(ofx::EffectHandle effect);
ofx::Status purge_caches(ofx::EffectHandle effect);
ofx::Status region_of_definition(ofx::EffectHandle effect, Properties in, Properties out);
ofx::Status regions_of_interest(ofx::EffectHandle effect, Properties in, Properties out);
ofx::Status clip_preferences(ofx::EffectHandle effect, Properties out);
ofx::Status is_identity(ofx::EffectHandle effect, Properties in, Properties out);
ofx::Status render(ofx::EffectHandle effect, Properties in);
ofx::Status attach_gl(ofx::EffectHandle effect);
ofx::Status detach_gl(ofx::EffectHandle effect);

}  // namespace openfx
