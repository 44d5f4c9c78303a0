// SPDX-License-Identifier: Apache-2.0
#include "cli/command_line.h"

#include <sstream>

#include <CLI/CLI.hpp>

#include "cli/command_tables.h"

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

namespace {

/// Splits a type such as "WORD:{fixed,free}" into the value's name and the accepted values.
void split_words(OptionTable& option) {
  const std::size_t colon = option.type.find(":{");
  if (colon == option.type.npos) return;
  std::istringstream words(option.type.substr(colon + 2));
  option.type.resize(colon);
  for (std::string word; std::getline(words, word, ',');) {
    if (word.ends_with('}')) word.pop_back();
    option.words.push_back(word);
  }
}

OptionTable table_of(const CLI::Option& option) {
  OptionTable table;
  for (const std::string& name : option.get_snames()) table.names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) table.names.push_back("--" + name);
  table.argument = option.get_positional();
  if (table.argument) table.names = {option.get_name(true)};
  if (option.get_items_expected_max() > 0) table.type = option.get_type_name();
  split_words(table);
  table.initial = option.get_default_str();
  table.help = option.get_description();
  table.required = option.get_required();
  table.repeated = option.get_multi_option_policy() == CLI::MultiOptionPolicy::TakeAll;
  return table;
}

void fill(const CLI::App& command, CommandTable& table) {
  table.name = command.get_name();
  table.help = command.get_description();
  for (const CLI::Option* option : command.get_options())
    table.options.push_back(table_of(*option));
}

}  // namespace

ProgramTable tables_of(const CLI::App& program) {
  ProgramTable table;
  fill(program, table);
  table.footer = program.get_footer();
  for (const CLI::App* command : program.get_subcommands(nullptr)) {
    fill(*command, table.commands.emplace_back());
  }
  return table;
}

}  // namespace crowdface::cli
