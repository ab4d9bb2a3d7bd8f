// The host that loaded the plugin: its suites, and the objects that its handles stand for.
#pragma once
#include <stdexcept>
#include <string>
#include <vector>

#include <brume/brume.h>

#include "ofx.h"

namespace openfx {

// What the user is told, by name and value.
struct Refusal : std::runtime_error {
    using std::runtime_error::runtime_error;
};

struct Suites {
    const ofx::PropertySuite *properties = nullptr;
    const ofx::EffectSuite *effects = nullptr;
    const ofx::ParameterSuite *parameters = nullptr;
    const ofx::MessageSuite *messages = nullptr;             // of version 1 or 2; null: none
    const ofx::MessageSuite *persistent_messages = nullptr;  // of version 2; null: none
    const ofx::ThreadSuite *threads = nullptr;               // null: none
    const ofx::GlSuite *gl = nullptr;                        // null: none
};

// Between the host's load and unload.
extern Suites suites;

ofx::Status fetch_suites(const ofx::Host *host);

class Properties {
public:
    Properties(ofx::PropertySet set) : set_(set) {}
    explicit operator bool() const { return set_ != nullptr; }

    // Those that a host does not know are passed over.
    void set(const char *name, const char *value, int index = 0) const
    {
        suites.properties->set_string(set_, name, index, value);
    }
    void set(const char *name, double value, int index = 0) const
    {
        suites.properties->set_double(set_, name, index, value);
    }
    void set(const char *name, int value, int index = 0) const { suites.properties->set_int(set_, name, index, value); }
    void set(const char *name, void *value) const { suites.properties->set_pointer(set_, name, 0, value); }
    void set(const char *name, const ofx::RectD &value) const;

    // What is not there is as given here.
    std::string text(const char *name) const;
    double number(const char *name, double otherwise) const;
    int integer(const char *name, int otherwise) const;
    void *pointer(const char *name) const;
    ofx::PointD point(const char *name, ofx::PointD otherwise) const;
    ofx::RectI rectangle(const char *name) const;

private:
    ofx::PropertySet set_;
};

Properties properties_of(ofx::EffectHandle effect);

// A clip of an instance; none where the host defined none.
class Clip {
public:
    Clip(ofx::EffectHandle effect, const char *name);
    bool connected() const { return properties_ && properties_.integer(ofx::property::connected, 0) != 0; }
    // In canonical coordinates.
    ofx::RectD region(ofx::Time time) const;
    const char *name() const { return name_; }
    ofx::ClipHandle handle() const { return handle_; }
    const Properties &properties() const { return properties_; }

private:
    const char *name_;
    ofx::ClipHandle handle_ = nullptr;
    Properties properties_;
};

// An image of a clip, held until destroyed. y is upwards, and rows may lie in memory either way. The library is given the
// top row first, as by any other program, so that the same picture has the same bits.
class ClipImage {
public:
    ClipImage(const Clip &clip, ofx::Time time);
    ~ClipImage() { suites.effects->clip_release_image(image_); }
    ClipImage(const ClipImage &) = delete;
    ClipImage &operator=(const ClipImage &) = delete;

    const ofx::RectI &bounds() const { return bounds_; }
    int width() const { return bounds_.x2 - bounds_.x1; }
    int height() const { return bounds_.y2 - bounds_.y1; }
    int channels() const { return channels_; }
    double pixel_aspect() const { return properties_.number(ofx::property::pixel_aspect, 1); }
    float *at(int x, int y) const;
    brume_image all_channels() const;
    brume_image one_channel(int channel) const;

private:
    ofx::PropertySet image_ = nullptr;
    Properties properties_;
    ofx::RectI bounds_{};
    int channels_ = 0;
    int row_bytes_ = 0;
    char *data_ = nullptr;
};

// Shows the user an error until it is withdrawn.
void show_error(ofx::EffectHandle effect, const std::string &text);
void withdraw_error(ofx::EffectHandle effect);

// How many threads the host grants; 0: it does not say.
unsigned granted_threads();

}  // namespace openfx
