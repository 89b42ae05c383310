// SPDX-License-Identifier: GPL-3.0-or-later
#include "bind/bindings.h"
#include "pipeline/options.h"
#include "pipeline/presets.h"

namespace py = pybind11;

namespace antiradiance {
namespace {

const char* type_name(OptionType type) {
    switch (type) {
        case OptionType::kEnum:
            return "ENUM";
        case OptionType::kInt:
            return "INT";
        case OptionType::kFloat:
            return "FLOAT";
        case OptionType::kPath:
            return "PATH";
        case OptionType::kBool:
            return "BOOL";
    }
    throw std::logic_error("option type without a name");
}

const char* unit_name(OptionUnit unit) {
    switch (unit) {
        case OptionUnit::kNone:
            return "NONE";
        case OptionUnit::kLength:
            return "LENGTH";
        case OptionUnit::kFactor:
            return "FACTOR";
    }
    throw std::logic_error("option unit without a name");
}

py::str text(std::string_view view) {
    return {view.data(), view.size()};
}

py::object value_of(const OptionInfo& option, const Options& options) {
    const OptionValue value = option.access.get(options);
    if (option.type == OptionType::kEnum) {
        return text(option.items.at(static_cast<std::size_t>(std::get<int>(value))).id);
    }
    return std::visit([](const auto& v) -> py::object { return py::cast(v); }, value);
}

py::dict to_dict(const OptionInfo& option) {
    py::dict entry;
    entry["name"] = text(option.name);
    entry["label"] = text(option.label);
    entry["tooltip"] = text(option.tooltip);
    entry["type"] = type_name(option.type);
    entry["default"] = value_of(option, Options{});
    entry["unit"] = unit_name(option.unit);
    entry["min"] = option.min;
    entry["max"] = option.max;
    entry["soft_min"] = option.soft_min;
    entry["soft_max"] = option.soft_max;
    entry["precision"] = option.precision;
    py::list items;
    for (const EnumItem& item : option.items) {
        items.append(py::make_tuple(text(item.id), text(item.label), text(item.tooltip)));
    }
    entry["items"] = items;
    return entry;
}

py::dict to_dict(const Preset& preset) {
    py::dict values;
    for (const OptionInfo& option : option_schema()) {
        if (!kept_by_presets(option.name)) {
            values[text(option.name)] = value_of(option, preset.options);
        }
    }
    py::dict entry;
    entry["id"] = text(preset.id);
    entry["label"] = text(preset.label);
    entry["tooltip"] = text(preset.tooltip);
    entry["values"] = values;
    return entry;
}

OptionValue to_option_value(const py::handle& value, const OptionInfo* option) {
    const bool wants_float = option != nullptr && option->type == OptionType::kFloat;
    if (py::isinstance<py::bool_>(value)) {
        return value.cast<bool>();
    }
    if (py::isinstance<py::int_>(value) && !wants_float) {
        return value.cast<int>();
    }
    if (py::isinstance<py::int_>(value) || py::isinstance<py::float_>(value)) {
        return value.cast<float>();
    }
    return value.cast<std::string>();
}

}  // namespace

Options to_options(const py::dict& values) {
    Options options;
    for (const auto& [key, value] : values) {
        const auto name = key.cast<std::string>();
        const OptionInfo* known = nullptr;
        for (const OptionInfo& option : option_schema()) {
            known = option.name == name ? &option : known;
        }
        set_option(options, name, to_option_value(value, known));
    }
    return options;
}

void bind_schema(py::module_& module) {
    module.def(
        "options_schema",
        [] {
            py::list entries;
            for (const OptionInfo& option : option_schema()) {
                entries.append(to_dict(option));
            }
            return entries;
        },
        "The settings in display order, one dict each: name, label, tooltip, type (ENUM, INT, "
        "FLOAT, PATH, BOOL), default, unit (NONE, LENGTH, FACTOR), min, max, soft_min, soft_max, "
        "precision, items [(id, label, tooltip)]");
    module.def(
        "active_options",
        [](const py::dict& values) {
            const Options options = to_options(values);
            py::set names;
            for (const OptionInfo& option : option_schema()) {
                if (option.active(options)) {
                    names.add(text(option.name));
                }
            }
            return names;
        },
        py::arg("options"),
        "Names of the settings that have an effect where they have these values");
    module.def(
        "presets",
        [] {
            py::list entries;
            for (const Preset& preset : presets()) {
                entries.append(to_dict(preset));
            }
            return entries;
        },
        "Named values of all settings but those of where and how to report, in display order: one "
        "dict each of id, label, tooltip, values {name: value}");
}

}  // namespace antiradiance
