// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace crowdface {

/// A token of a USD text layer: a word, a quoted text or path, or a punctuation character.
struct UsdaToken {
  /// kEnd: the text has ended; kSign: a punctuation character.
  enum class Kind { kEnd, kWord, kQuoted, kSign } kind = Kind::kEnd;
  std::string_view text;  ///< the token without quotation marks; empty for kEnd
  /// Whether the token is this punctuation character.
  bool is(char sign) const { return kind == Kind::kSign && text.front() == sign; }
  bool is_word(std::string_view word) const { return kind == Kind::kWord && text == word; }
};

/// Tokeniser for USD text layers (usda).
class UsdaTokens {
 public:
  /// \param name  name of the file, for messages.
  /// \throws InvalidInput if the text does not begin like a USD layer.
  UsdaTokens(std::string_view text, const std::string& name);

  /// Consumes and returns the next token.
  UsdaToken next();
  /// Consumes the next token if it is this punctuation character.
  /// \return whether the token was consumed.
  bool consume(char sign);
  /// Consumes everything up to the closing bracket of a group whose opening bracket is already
  /// consumed.
  /// \return the value of `key` in the group; empty if the group does not set it.
  std::string consume_group(std::string_view key = "interpolation");
  /// Consumes a value, which may have brackets, and returns all numbers in it.
  /// \param list  name of the value, for messages.
  std::vector<double> read_numbers(std::string_view list);
  /// Throws InvalidInput with the file's name and `what`.
  [[noreturn]] void fail(std::string_view what) const;

 private:
  /// Skips whitespace and comments.
  void skip_blanks();
  /// Returns the text before `end`. Consumes this text and `end`.
  /// \param escapes  whether a backslash protects the character after it from ending the text.
  std::string_view text_before(std::string_view end, bool escapes);

  std::string_view text_;     ///< the text of the layer
  const std::string& name_;   ///< name of the file, for messages
  std::size_t position_ = 0;  ///< offset in `text_` of the first character not yet consumed
};

}  // namespace crowdface
