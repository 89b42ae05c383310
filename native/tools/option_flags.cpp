// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/option_flags.h"

#include <algorithm>
#include <cctype>
#include <sstream>
#include <string>
#include <vector>

#include "base/error.h"
#include "pipeline/presets.h"

namespace antiradiance {

namespace {

std::string flag_of(const OptionInfo& option) {
    std::string flag = "--" + std::string(option.name);
    std::replace(flag.begin(), flag.end(), '_', '-');
    return flag;
}

std::string number_text(double number) {
    std::ostringstream text;
    text << number;
    return std::move(text).str();
}

std::string default_of(const OptionInfo& option) {
    const OptionValue value = option.access.get(Options{});
    if (const auto* i = std::get_if<int>(&value)) {
        return option.type == OptionType::kEnum
                   ? std::string(option.items[static_cast<std::size_t>(*i)].id)
                   : std::to_string(*i);
    }
    if (const auto* f = std::get_if<float>(&value)) return number_text(static_cast<double>(*f));
    return option.type == OptionType::kPath ? std::get<std::string>(value) : "";
}

std::string help_of(const OptionInfo& option) {
    std::string help(option.tooltip);
    for (const EnumItem& item : option.items)
        help += "\n" + std::string(item.id) + ": " + std::string(item.tooltip);
    if (option.type == OptionType::kInt || option.type == OptionType::kFloat) {
        help += "; " + number_text(option.min) + " to " + number_text(option.max) +
                (option.unit == OptionUnit::kLength ? " m" : "");
    }
    return help;
}

template <typename Value>
CLI::Option* add(CLI::App& command, Options& options, const OptionInfo& option) {
    const auto set = [&options, &option](const Value& value) {
        try {
            set_option(options, option.name, value);
        } catch (const SceneError& error) {
            throw CLI::ValidationError(flag_of(option), error.what());
        }
    };
    return command.add_option_function<Value>(flag_of(option), set, help_of(option))
        ->default_str(default_of(option))
        ->group("Engine");
}

std::vector<std::string> ids_of(const OptionInfo& option) {
    std::vector<std::string> ids;
    for (const EnumItem& item : option.items)
        ids.emplace_back(item.id);
    return ids;
}

// An item in upper or lower case; what is refused with its reason.
CLI::Validator item_of(const OptionInfo& option) {
    const CLI::IsMember known(ids_of(option), CLI::ignore_case);
    const auto check = [known, &option](std::string& id) {
        std::string upper = id;
        std::ranges::transform(upper, upper.begin(),
                               [](unsigned char c) { return std::toupper(c); });
        const std::string_view why = why_refused(option, upper);
        return why.empty() ? known(id) : std::string(why);
    };
    return {check, known.get_description()};
}

void add_preset_flag(CLI::App& command, Options& options) {
    std::string help =
        "What the settings start from, but for --solver and --report-path; flags change it";
    std::vector<std::string> ids;
    for (const Preset& preset : presets()) {
        help += "\n" + std::string(preset.id) + ": " + std::string(preset.tooltip);
        ids.emplace_back(preset.id);
    }
    const auto apply = [&options](const std::string& id) { apply_preset(options, id); };
    command.add_option_function<std::string>("--preset", apply, help)
        ->transform(CLI::IsMember(ids, CLI::ignore_case))
        ->default_str(std::string(presets().front().id))
        ->group("Engine");
}

}  // namespace

void add_option_flags(CLI::App& command, Options& options) {
    // Before the others: flags take effect in this order, whatever the command line's is.
    add_preset_flag(command, options);
    for (const OptionInfo& option : option_schema()) {
        switch (option.type) {
            case OptionType::kEnum:
                add<std::string>(command, options, option)->transform(item_of(option));
                break;
            case OptionType::kInt:
                add<int>(command, options, option);
                break;
            case OptionType::kFloat:
                add<float>(command, options, option);
                break;
            case OptionType::kPath:
                add<std::string>(command, options, option)->type_name("FILE");
                break;
            case OptionType::kBool:
                add<bool>(command, options, option)->type_name("true|false");
                break;
        }
    }
}

}  // namespace antiradiance
