// SPDX-License-Identifier: Apache-2.0
#include <functional>
#include <string>

#include "crowdface/core/error.h"
#include "crowdface/core/text.h"
#include "crowdface/core/version.h"

#include "cli/command_line.h"
#include "cli/command_tables.h"
#include "cli/commands.h"
#include "cli/common_options.h"

namespace crowdface::cli {
namespace {

/// Quotes a text so that bash and zsh read it as one word.
std::string in_quotes(const std::string& text) {
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return result + "'";
}

/// Returns the text with a backslash before each of the given characters.
std::string escaped(const std::string& text, std::string_view characters) {
  std::string result;
  for (const char c : text) {
    if (characters.find(c) != characters.npos) result += '\\';
    result += c;
  }
  return result;
}

/// Returns the first sentence of a help text, for the menus of completions.
std::string short_help(const std::string& help) {
  return help.substr(0, help.find_first_of(";\n"));
}

bool is_folder_type(const OptionDescription& option) {
  return option.type.ends_with("DIR");
}

std::vector<std::string> option_names(const CommandDescription& command) {
  std::vector<std::string> names;
  for (const OptionDescription& option : command.options) {
    if (!option.is_argument) names.insert(names.end(), option.names.begin(), option.names.end());
  }
  return names;
}

/// Returns the `case` branch, in the bash completion function, that completes one command.
std::string bash_case(const CommandDescription& command) {
  std::string values, words;
  for (const OptionDescription& option : command.options) {
    if (option.is_argument) {
      for (const std::string& word : option.accepted_values) words += concat(' ', word);
      continue;
    }
    if (option.type.empty()) continue;
    std::string reply;  // empty: bash completes file names
    if (!option.accepted_values.empty()) {
      reply = concat("COMPREPLY=($(compgen -W ", in_quotes(join(option.accepted_values, " ")),
                     " -- \"$current\")); ");
    } else if (is_folder_type(option)) {
      reply = "compopt -o dirnames; ";
    }
    values += concat("        ", join(option.names, " | "), ") ", reply, "return ;;\n");
  }
  return concat("    ", in_quotes(command.name), ")\n      case $previous in\n", values,
                "      esac\n      options=", in_quotes(join(option_names(command), " ")),
                " words=", in_quotes(words), " ;;\n");
}

std::string bash_script(const ProgramDescription& program) {
  std::vector<std::string> names;
  std::string cases;
  for (const CommandDescription& command : program.commands) {
    names.push_back(command.name);
    cases += bash_case(command);
  }
  CommandDescription none = program;
  none.name.clear();
  return concat(
      "# Completion of crowdface for bash; made by: crowdface completion bash\n"
      "_crowdface() {\n"
      "  local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD-1]}\n"
      "  local command= options= words= word\n"
      "  COMPREPLY=()\n"
      "  for word in \"${COMP_WORDS[@]:1:COMP_CWORD-1}\"; do\n"
      "    case $word in -*) ;; *) command=$word; break ;; esac\n"
      "  done\n"
      "  case $command in\n",
      bash_case(none), cases,
      "  esac\n  [ -n \"$command\" ] || words=", in_quotes(join(names, " ")),
      "\n"
      "  case $current in\n"
      "    -*) COMPREPLY=($(compgen -W \"$options\" -- \"$current\")) ;;\n"
      "    *) COMPREPLY=($(compgen -W \"$words\" -- \"$current\")) ;;\n"
      "  esac\n"
      "}\n"
      "complete -o bashdefault -o default -F _crowdface crowdface\n");
}

/// Returns the action with which zsh completes the value of an option.
std::string zsh_action(const OptionDescription& option) {
  if (!option.accepted_values.empty()) return concat('(', join(option.accepted_values, " "), ')');
  return is_folder_type(option) ? "_files -/" : "_files";
}

/// The specifications of the options and arguments of one command, in the format of zsh's function
/// _arguments.
std::string zsh_arguments(const CommandDescription& command) {
  std::string specifications;
  for (const OptionDescription& option : command.options) {
    const std::string type = escaped(option.type, ":[]");
    const std::string value = option.type.empty() ? "" : concat(':', type, ':', zsh_action(option));
    if (option.is_argument) {
      specifications += concat(" \\\n        ", in_quotes(value));
      continue;
    }
    for (const std::string& name : option.names) {
      specifications += concat(
          " \\\n        ", in_quotes(concat(option.is_repeated ? "*" : "", name, '[',
                                            escaped(short_help(option.help), "[]\\"), ']', value)));
    }
  }
  return specifications;
}

std::string zsh_script(const ProgramDescription& program) {
  std::string names, cases;
  for (const CommandDescription& command : program.commands) {
    names += concat("    ", in_quotes(concat(command.name, ':', command.help)), "\n");
    cases += concat("    ", command.name, ")\n      _arguments", zsh_arguments(command), " ;;\n");
  }
  return concat(
      "#compdef crowdface\n"
      "# Completion of crowdface for zsh; made by: crowdface completion zsh\n"
      "local -a commands=(\n",
      names,
      ")\n"
      "if ((CURRENT == 2)); then\n"
      "  if [[ $PREFIX == -* ]]; then\n"
      "    _arguments",
      zsh_arguments(program),
      "\n"
      "  else\n"
      "    _describe command commands\n"
      "  fi\n"
      "else\n"
      "  local command=$words[2]\n"
      "  shift words\n"
      "  ((CURRENT--))\n"
      "  case $command in\n",
      cases, "  esac\nfi\n");
}

std::string fish_line(const std::string& condition, const std::string& rest,
                      const std::string& help) {
  return concat("complete -c crowdface -n '", condition, "' ", rest, " -d '",
                escaped(short_help(help), "'\\"), "'\n");
}

std::string fish_options(const CommandDescription& command, const std::string& condition) {
  std::string lines;
  for (const OptionDescription& option : command.options) {
    std::string rest;
    for (const std::string& name : option.names) {
      if (!option.is_argument) {
        rest += name.starts_with("--") ? concat("-l ", name.substr(2), ' ')
                                       : concat("-s ", name.substr(1), ' ');
      }
    }
    if (!option.accepted_values.empty()) {
      rest +=
          concat(option.is_argument ? "" : "-x ", "-a '", join(option.accepted_values, " "), "'");
    } else if (option.is_argument) {
      continue;  // fish completes file names
    } else if (is_folder_type(option)) {
      rest += "-x -a '(__fish_complete_directories)'";
    } else if (!option.type.empty()) {
      rest += "-r";
    }
    lines += fish_line(condition, rest, option.help);
  }
  return lines;
}

std::string fish_script(const ProgramDescription& program) {
  std::string lines = "# Completion of crowdface for fish; made by: crowdface completion fish\n";
  lines += fish_options(program, "__fish_use_subcommand");
  for (const CommandDescription& command : program.commands) {
    lines += fish_line("__fish_use_subcommand", concat("-f -a ", command.name), command.help);
    lines += fish_options(command, concat("__fish_seen_subcommand_from ", command.name));
  }
  return lines;
}

/// Escapes a text for groff. Escapes control characters at the start of a line. Also escapes
/// hyphens, so that a user can copy them from the manual page as ASCII.
std::string roff(const std::string& text) {
  std::string result;
  bool at_start = true;
  for (const char c : text) {
    if (at_start && (c == '.' || c == '\'')) result += "\\&";
    if (c == '\\') {
      result += "\\e";
    } else if (c == '-') {
      result += "\\-";
    } else {
      result += c;
    }
    at_start = c == '\n';
  }
  return result;
}

std::string bold(const std::string& text) {
  return concat("\\fB", roff(text), "\\fR");
}

std::string roff_options(const CommandDescription& command) {
  std::string text;
  for (const OptionDescription& option : command.options) {
    std::vector<std::string> names;
    if (!option.is_argument) {
      for (const std::string& name : option.names) names.push_back(bold(name));
    }
    const std::string words =
        option.accepted_values.empty() ? option.type : join(option.accepted_values, " | ");
    const std::string value = option.type.empty() ? "" : concat("\\fI", roff(words), "\\fR");
    text += concat(
        ".TP\n", join(names), names.empty() || value.empty() ? "" : " ", value, '\n',
        roff(option.help),
        option.default_value.empty() ? "" : concat(" (default: ", roff(option.default_value), ')'),
        option.is_required && !option.is_argument ? " (required)" : "", ".\n");
  }
  return text;
}

std::string synopsis(const CommandDescription& command) {
  std::string text = concat(".B crowdface ", command.name, "\n[\\fIoptions\\fR]");
  for (const OptionDescription& option : command.options) {
    if (!option.is_argument) continue;
    const std::string name = concat("\\fI", roff(option.type), "\\fR");
    text += option.is_required ? concat(' ', name) : concat(" [", name, ']');
  }
  return text + '\n';
}

CommandAction add_printer(
    CLI::App& program, const char* name, const char* help,
    const std::function<void(CLI::App&, std::string&)>& declare,
    const std::function<std::string(const ProgramDescription&, const std::string&)>& make) {
  const auto word = std::make_shared<std::string>();
  declare(add_subcommand(program, name, help), *word);
  return [&program, word, make] { print(make(describe_program(program), *word)); };
}

/// Returns the script with which a shell completes commands, options and the values of options.
/// \param shell  "bash", "zsh" or "fish".
std::string completion_script(const ProgramDescription& program, const std::string& shell) {
  if (shell == "bash") return bash_script(program);
  return shell == "zsh" ? zsh_script(program) : fish_script(program);
}

/// The manual page of the program and all its commands, for `man` (groff's man macros).
std::string manual_page(const ProgramDescription& program) {
  std::string text =
      concat(".TH CROWDFACE 1 \"\" \"crowdface ", kVersion,
             "\" \"User Commands\"\n.SH NAME\ncrowdface \\- ",
             roff("crowds of believable faces from a handful of scanned heads"),
             "\n.SH SYNOPSIS\n.B crowdface\n\\fIcommand\\fR [\\fIoptions\\fR]\n"
             ".SH DESCRIPTION\n.nf\n",
             roff(program.help), "\n.fi\n.SH OPTIONS\n", roff_options(program), ".SH COMMANDS\n");
  for (const CommandDescription& command : program.commands) {
    text += concat(".SS ", command.name, '\n', synopsis(command), ".PP\n", roff(command.help),
                   ".\n", roff_options(command));
  }
  return text + concat(".SH EXIT STATUS\n.nf\n", roff(program.footer), "\n.fi\n");
}

}  // namespace

CommandAction add_completion(CLI::App& program) {
  return add_printer(
      program, "completion", "Print the script with which a shell completes this command line",
      [](CLI::App& command, std::string& shell) {
        add_option(command, "shell", shell, "SHELL", "The shell: bash, zsh or fish")
            .required()
            .one_of({"bash", "zsh", "fish"});
      },
      completion_script);
}

CommandAction add_manual(CLI::App& program) {
  return add_printer(
      program, "manual", "Print the manual page, for man", [](CLI::App&, std::string&) {},
      [](const ProgramDescription& tables, const std::string&) { return manual_page(tables); });
}

}  // namespace crowdface::cli
