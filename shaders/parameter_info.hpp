// Rows of an effect's parameter table.
#pragma once
#include <brume/brume_plugin.h>

namespace brume_parameters {

constexpr brume_parameter_info choice(const char *name, const char *choices, double first, const char *help,
                                      const char *alias = "")
{
    return {sizeof(brume_parameter_info), BRUME_PARAMETER_CHOICE, 0, 0, first, name, "", help, choices, alias};
}

constexpr brume_parameter_info boolean(const char *name, bool first, const char *help)
{
    return {sizeof(brume_parameter_info), BRUME_PARAMETER_BOOLEAN, 0, 1, first ? 1.0 : 0.0, name, "", help, "", ""};
}

constexpr brume_parameter_info number(const char *name, double minimum, double maximum, double first, const char *unit,
                                      const char *help)
{
    return {sizeof(brume_parameter_info), BRUME_PARAMETER_NUMBER, minimum, maximum, first, name, unit, help, "", ""};
}

constexpr brume_parameter_info integer(const char *name, double minimum, double maximum, double first, const char *unit,
                                       const char *help)
{
    return {sizeof(brume_parameter_info), BRUME_PARAMETER_INTEGER, minimum, maximum, first, name, unit, help, "", ""};
}

}  // namespace brume_parameters
