// SPDX-License-Identifier: Apache-2.0
#include "cli/command_line.h"

#include <CLI/CLI.hpp>

namespace crowdface::cli {

AddedOption AddedOption::required() const {
  option_->required();
  return *this;
}

AddedOption AddedOption::one_of(const std::vector<std::string>& words) const {
  option_->check(CLI::IsMember(words));
  return *this;
}

AddedOption AddedOption::shown_default(const std::string& text) const {
  option_->default_str(text);
  return *this;
}

AddedOption AddedOption::needs(const std::string& other) const {
  option_->needs(other);
  return *this;
}

AddedOption AddedOption::excludes(const std::vector<std::string>& others) const {
  for (const std::string& other : others) option_->excludes(other);
  return *this;
}

CLI::App& add_subcommand(CLI::App& program, const char* name, const char* description) {
  return *program.add_subcommand(name, description);
}

AddedOption add_flag(CLI::App& command, const std::string& name, bool& value,
                     const std::string& help) {
  return AddedOption(*command.add_flag(name, value, help));
}

AddedOption add_option(CLI::App& command, const std::string& name, std::string& value,
                       const std::string& type, const std::string& help) {
  CLI::Option* option = command.add_option(name, value, help)->type_name(type);
  return AddedOption(value.empty() ? *option : *option->capture_default_str());
}

AddedOption add_option(CLI::App& command, const std::string& name,
                       const std::function<void(const std::string&)>& take, const std::string& type,
                       const std::string& help) {
  return AddedOption(*command.add_option_function<std::string>(name, take, help)->type_name(type));
}

AddedOption add_optional(CLI::App& command, const std::string& name,
                         std::optional<std::string>& value, const std::string& type,
                         const std::string& help) {
  return add_option(
      command, name, [&value](const std::string& text) { value = text; }, type, help);
}

AddedOption add_repeated(CLI::App& command, const std::string& name,
                         std::vector<std::string>& values, const std::string& type,
                         const std::string& help) {
  return AddedOption(*command.add_option(name, values, help + "; may be repeated")
                          ->type_name(type)
                          ->expected(1)
                          ->take_all());
}

}  // namespace crowdface::cli
