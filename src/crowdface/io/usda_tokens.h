// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace crowdface {

/// A word, a quoted text or path, or a bracket or the like of a USD layer.
struct UsdaToken {
  enum class Kind { kEnd, kWord, kQuoted, kSign } kind = Kind::kEnd;
  std::string_view text;
  bool is(char sign) const { return kind == Kind::kSign && text.front() == sign; }
  bool is_word(std::string_view word) const { return kind == Kind::kWord && text == word; }
};

/// Takes the text of a USD layer (usda) apart.
class UsdaTokens {
 public:
  /// \param name  of the file, for messages. \throws InvalidInput if the text does not begin as a layer does
  UsdaTokens(std::string_view text, const std::string& name);

  UsdaToken next();
  /// Passes this sign if it comes next.
  bool pass(char sign);
  /// Passes everything up to the end of brackets of which the first was passed. \return the interpolation that is named there
  std::string skip_rest();
  /// All numbers of a value, whatever the brackets.
  std::vector<double> numbers();
  /// \throws InvalidInput
  [[noreturn]] void fail(std::string_view what) const;

 private:
  void skip_blanks();
  /// What stands before an end, which is passed.
  std::string_view up_to(std::string_view end, bool escapes);

  std::string_view text_;
  const std::string& name_;
  std::size_t at_ = 0;
};

}  // namespace crowdface
