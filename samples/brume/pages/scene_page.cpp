#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "pages/manual.hpp"
#include "pages/roff.hpp"

namespace brume::pages {
namespace {

using Json = nlohmann::ordered_json;

class ScenePage {
public:
    explicit ScenePage(const std::string &schema) : _schema(Json::parse(schema)) {}

    std::string sections()
    {
        std::string text = ".SH KEYS\n";
        for (const auto &[key, schema] : _schema["properties"].items())
            if (!has_keys(schema))
                text += entry(key, schema);
        for (const auto &[key, schema] : _schema["properties"].items())
            if (has_keys(schema)) {
                text += ".SS " + roff(key) + "\n";
                if (schema.contains("description"))
                    text += roff(std::string(schema["description"]) + ".") + "\n";
                std::string keys = keys_of(key, schema);
                // mandoc warns of a paragraph that starts where a section does.
                if (!schema.contains("description") && keys.starts_with(".PP\n"))
                    keys.erase(0, 4);
                text += keys;
            }
        return text;
    }

private:
    static bool has_keys(const Json &schema)
    {
        if (schema.contains("properties"))
            return true;
        if (schema.contains("oneOf"))
            for (const Json &one : schema["oneOf"])
                if (has_keys(one))
                    return true;
        return schema.contains("items") && has_keys(schema["items"]);
    }

    static std::string plain(const Json &value) { return value.is_string() ? std::string(value) : value.dump(); }

    static std::string number_text(const Json &schema)
    {
        const bool whole = schema["type"] == "integer";
        std::string text = whole ? "whole number" : "number";
        auto finite = [&](const char *key) { return schema.contains(key) && std::abs(double(schema[key])) < 1e15; };
        if (finite("minimum") && finite("maximum"))
            return text + fmt::format(", {:g} to {:g}", double(schema["minimum"]), double(schema["maximum"]));
        if (finite("exclusiveMinimum"))
            text += fmt::format(", above {:g}", double(schema["exclusiveMinimum"]));
        if (finite("minimum"))
            text += fmt::format(", {:g} or more", double(schema["minimum"]));
        if (finite("exclusiveMaximum"))
            text += fmt::format(", below {:g}", double(schema["exclusiveMaximum"]));
        if (finite("maximum"))
            text += fmt::format(", {:g} at most", double(schema["maximum"]));
        return text;
    }

    static std::string type_text(const Json &schema)
    {
        if (schema.contains("const"))
            return plain(schema["const"]);
        std::string text;
        if (schema.contains("enum")) {
            for (const Json &value : schema["enum"])
                text += (text.empty() ? "" : ", ") + plain(value);
            return "one of " + text;
        }
        for (const char *key : {"anyOf", "oneOf"})
            if (schema.contains(key)) {
                for (const Json &one : schema[key])
                    if (const std::string type = type_text(one); !type.empty())
                        text += (text.empty() ? "" : "; or ") + type;
                return text;
            }
        const std::string type = schema.value("type", "");
        if (type == "object")
            return schema["properties"].contains("keys") ? "keyed" : "";
        if (type == "array") {
            const std::string items = type_text(schema["items"]);
            if (schema.contains("minItems") && schema["minItems"] == schema.value("maxItems", Json()))
                return fmt::format("[{} of: {}]", schema["minItems"].dump(), items);
            return fmt::format("[{}, ...]", items);
        }
        return type == "number" || type == "integer" ? number_text(schema) : type == "boolean" ? "true or false" : type;
    }

    static std::string entry(const std::string &path, const Json &schema)
    {
        std::string description = schema.value("description", "");
        if (!description.empty() && !description.ends_with('.'))
            description += '.';
        std::string type = type_text(schema);
        if (schema.contains("default"))
            type += "; default: " + plain(schema["default"]);
        return fmt::format(".TP\n{}\n{}{}({})\n", bold(path), roff(description), description.empty() ? "" : "\n",
                           roff(type));
    }

    static std::string alternative_name(const Json &schema)
    {
        const Json &properties = schema["properties"];
        if (properties.contains("type"))
            return plain(properties["type"]["const"]);
        return "";
    }

    static std::string keys_of(const std::string &path, const Json &schema)
    {
        std::string text;
        if (schema.contains("items") && has_keys(schema["items"]))
            return keys_of(path + "[]", schema["items"]);
        if (schema.contains("oneOf")) {
            for (const Json &one : schema["oneOf"]) {
                if (!has_keys(one))
                    continue;
                const std::string name = alternative_name(one);
                text += ".PP\n" +
                        (name.empty() ? std::string(text.empty() ? "Either:" : "Or:")
                                      : "With " + bold(path + ".type") + " " + bold(name) + ":") +
                        "\n";
                text += keys_of(path, one);
            }
            return text;
        }
        for (const auto &[key, value] : schema["properties"].items()) {
            const std::string below = path + "." + key;
            if (key == "type" && value.contains("const"))
                continue;
            if (has_keys(value)) {
                if (value.contains("description"))
                    text += fmt::format(".TP\n{}\n{}\n", bold(below), roff(std::string(value["description"]) + "."));
                text += keys_of(below, value);
            } else {
                text += entry(below, value);
            }
        }
        return text;
    }

    Json _schema;
};

}  // namespace

std::string scene_page(const std::string &schema, const std::string &date)
{
    return head("brume-scene", 5, date, "scene files of brume(1)") + ".SH DESCRIPTION\n" +
           roff("A scene file says what the medium is, where the camera stands and which lights shine. It is JSON in UTF-8. "
                "Keys "
                "that are not in this page, wrong types and values out of range are errors. Where \"keyed\" stands, "
                "{ \"keys\": [[FRAME, VALUE], ...] } gives the value over the frames: linear between keys, constant beyond "
                "them. `brume schema` prints this page's content as a JSON Schema, and `brume effects` that of further "
                "plugins.") +
           "\n" + ScenePage(schema).sections() + ".SH EXAMPLES\n.nf\n" +
           roff("{ \"brume\": 1,\n  \"camera\": { \"vertical_fov\": 50 },\n"
                "  \"medium\": { \"scattering\": [0.02, 0.02, 0.022], \"g\": 0.8 } }") +
           "\n.fi\n.SH SEE ALSO\n" + bold("brume") + "(1),\n" + bold("brume-schema") + "(1),\n" + bold("brume-effects") +
           "(1)\n";
}

}  // namespace brume::pages
