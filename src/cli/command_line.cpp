// SPDX-License-Identifier: Apache-2.0
#include "cli/command_line.h"

#include <sstream>

#include <CLI/CLI.hpp>

#include "cli/command_tables.h"

namespace crowdface::cli {

OptionHandle OptionHandle::required() const {
  option_->required();
  return *this;
}

OptionHandle OptionHandle::one_of(const std::vector<std::string>& words) const {
  option_->check(CLI::IsMember(words));
  return *this;
}

OptionHandle OptionHandle::show_default(const std::string& text) const {
  option_->default_str(text);
  return *this;
}

OptionHandle OptionHandle::needs(const std::string& other) const {
  option_->needs(other);
  return *this;
}

OptionHandle OptionHandle::excludes(const std::vector<std::string>& others) const {
  for (const std::string& other : others) option_->excludes(other);
  return *this;
}

CLI::App& add_subcommand(CLI::App& program, const char* name, const char* description) {
  return *program.add_subcommand(name, description);
}

OptionHandle add_flag(CLI::App& command, const std::string& name, bool& value,
                      const std::string& help) {
  return OptionHandle(*command.add_flag(name, value, help));
}

OptionHandle add_option(CLI::App& command, const std::string& name, std::string& value,
                        const std::string& type, const std::string& help) {
  CLI::Option* option = command.add_option(name, value, help)->type_name(type);
  return OptionHandle(value.empty() ? *option : *option->capture_default_str());
}

OptionHandle add_option(CLI::App& command, const std::string& name,
                        const std::function<void(const std::string&)>& take,
                        const std::string& type, const std::string& help) {
  return OptionHandle(*command.add_option_function<std::string>(name, take, help)->type_name(type));
}

OptionHandle add_optional(CLI::App& command, const std::string& name,
                          std::optional<std::string>& value, const std::string& type,
                          const std::string& help) {
  return add_option(
      command, name, [&value](const std::string& text) { value = text; }, type, help);
}

OptionHandle add_repeated(CLI::App& command, const std::string& name,
                          std::vector<std::string>& values, const std::string& type,
                          const std::string& help) {
  return OptionHandle(*command.add_option(name, values, help + "; may be repeated")
                           ->type_name(type)
                           ->expected(1)
                           ->take_all());
}

namespace {

/// Splits an option's type, such as "WORD:{fixed,free}", into the name of the value (WORD) and the
/// accepted values.
void split_words(OptionDescription& option) {
  const std::size_t colon = option.type.find(":{");
  if (colon == option.type.npos) return;
  std::istringstream words(option.type.substr(colon + 2));
  option.type.resize(colon);
  for (std::string word; std::getline(words, word, ',');) {
    if (word.ends_with('}')) word.pop_back();
    option.accepted_values.push_back(word);
  }
}

OptionDescription table_of(const CLI::Option& option) {
  OptionDescription table;
  for (const std::string& name : option.get_snames()) table.names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) table.names.push_back("--" + name);
  table.is_argument = option.get_positional();
  if (table.is_argument) table.names = {option.get_name(true)};
  if (option.get_items_expected_max() > 0) table.type = option.get_type_name();
  split_words(table);
  table.default_value = option.get_default_str();
  table.help = option.get_description();
  table.is_required = option.get_required();
  table.is_repeated = option.get_multi_option_policy() == CLI::MultiOptionPolicy::TakeAll;
  return table;
}

void fill(const CLI::App& command, CommandDescription& table) {
  table.name = command.get_name();
  table.help = command.get_description();
  for (const CLI::Option* option : command.get_options())
    table.options.push_back(table_of(*option));
}

}  // namespace

ProgramDescription describe_program(const CLI::App& program) {
  ProgramDescription table;
  fill(program, table);
  table.footer = program.get_footer();
  for (const CLI::App* command : program.get_subcommands(nullptr)) {
    fill(*command, table.commands.emplace_back());
  }
  return table;
}

}  // namespace crowdface::cli
