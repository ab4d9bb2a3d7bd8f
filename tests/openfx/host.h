// A host that loads the bundle as hosts do: what it gives are handles, suites, properties by name, and images in memory of
// any layout.
#pragma once
#include <atomic>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "hosts/openfx/ofx.h"

namespace host {

using Value = std::variant<std::monostate, void *, std::string, double, int>;

struct Set {
    std::map<std::string, std::vector<Value>> values;

    template <class Type> void put(const std::string &name, std::initializer_list<Type> list)
    {
        values[name].assign(list.begin(), list.end());
    }
    template <class Type> Type get(const std::string &name, size_t index = 0) const
    {
        return std::get<Type>(values.at(name).at(index));
    }
    std::vector<std::string> strings(const std::string &name) const;
};

// A picture in pixel coordinates, y upwards. Its memory may run either way, with bytes of nobody between rows.
class Picture {
public:
    Picture(ofx::RectI bounds, int channels, bool downwards = false, int padding = 0);
    float &at(int x, int y, int channel);
    float at(int x, int y, int channel) const { return const_cast<Picture *>(this)->at(x, y, channel); }
    // What a host hands out; released by the plugin.
    Set *hand_out();

    const ofx::RectI bounds;
    const int channels;
    double aspect = 1;
    std::string depth = ofx::pixels::floating;
    int handed_out = 0;
    // Of its textures: GL_TEXTURE_2D, and 0 for the one in floats that its channels have.
    unsigned target = 0x0DE1, format = 0;
    bool mipmapped = true;  // or its filter wants mipmaps that it does not have
    int textures = 0;       // loaded so far

private:
    bool downwards_;
    int row_;  // floats from a row to that above
    std::vector<float> memory_;
    Set properties_;
};

struct Parameter {
    std::string type;
    Set properties;
    std::vector<double> numbers;               // of numbers, colours and choices
    std::function<double(double)> animated{};  // by time, if any
    std::string text{};
};

struct Clip {
    Set properties;
    Picture *picture = nullptr;
    ofx::RectD region{};
    bool is_output = false;
};

// A descriptor, or an instance.
struct Effect {
    Set properties;
    std::map<std::string, Parameter> parameters;
    std::map<std::string, Clip> clips;
    std::vector<std::string> order;  // of the clips
    std::string error;               // that is shown
    int polls = 0;                   // how often it asked whether to abort
    int abort_at = 0;                // the poll that is answered with yes; 0: none
};

struct Options {
    bool messages = true;
    bool threads = true;
    bool parameters = true;
    bool gl = false;  // offers textures of the context that is current
};

// The plugin in the memory of this process, from its load to its unload. One at a time: a library is in a process once.
class Bundle {
public:
    explicit Bundle(const Options &options = {});
    ~Bundle();
    static bool is_mapped();
    ofx::Status act(const char *action, const void *handle = nullptr, Set *in = nullptr, Set *out = nullptr) const;
    // Described, and described in the context.
    Effect describe(const char *context) const;

    ofx::Plugin *plugin = nullptr;
    ofx::Status loaded = ofx::unknown;

private:
    void *library_ = nullptr;
    Options options_;
    std::unique_ptr<Set> properties_;
    std::unique_ptr<ofx::Host> host_;
};

class Instance {
public:
    Instance(const Bundle &bundle, const char *context);
    ~Instance();
    void set(const std::string &parameter, std::vector<double> numbers)
    {
        effect.parameters.at(parameter).numbers = std::move(numbers);
    }
    void set_text(const std::string &parameter, const std::string &text) { effect.parameters.at(parameter).text = text; }
    // In canonical coordinates the region is the picture's, at this scale.
    void connect(const std::string &clip, Picture &picture);
    void project(double x, double y, double width, double height);
    ofx::Status render(const ofx::RectI &window, double time = 0) const
    {
        return act_on_frame(ofx::action::render, window, time);
    }
    // The clip that it is identical with; "": none.
    std::string identity(double time = 0) const;

    const Bundle &bundle;
    mutable Effect effect;
    ofx::PointD scale{1, 1};
    bool on_gl = false;
    ofx::Status created;

private:
    ofx::Status act_on_frame(const char *action, const ofx::RectI &window, double time, Set *out = nullptr) const;
};

}  // namespace host
