// SPDX-License-Identifier: GPL-3.0-or-later
#include "bind/bindings.h"
#include "pipeline/options.h"

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

py::object default_of(const OptionInfo& option) {
    const OptionValue value = option.access.get(Options{});
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
    entry["default"] = default_of(option);
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

}  // namespace

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
}

}  // namespace antiradiance
