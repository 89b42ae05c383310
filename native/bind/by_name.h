// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <pybind11/pybind11.h>

#include <initializer_list>
#include <string>
#include <utility>

namespace antiradiance {

// The value that `name` stands for; the error for an unknown one lists the valid ones.
template <typename Value>
Value by_name(const std::string& name, const std::string& what,
              std::initializer_list<std::pair<const char*, Value>> table) {
    std::string valid;
    for (const auto& [id, value] : table) {
        if (name == id) {
            return value;
        }
        valid += valid.empty() ? id : std::string(", ") + id;
    }
    throw pybind11::value_error(what + " must be one of " + valid + ", not '" + name + "'");
}

}  // namespace antiradiance
