// SPDX-License-Identifier: Apache-2.0
#include "crowdface/editor/flow_list.h"

#include <algorithm>

#include "crowdface/core/text.h"

namespace crowdface {
namespace {

constexpr std::string_view kBlanks = " \t\r\n", kMarks = ",[]{}";

bool is_one_of(char c, std::string_view characters) {
  return characters.find(c) != characters.npos;
}

/// Goes through what stands in brackets (YAML 1.2, chapter 7.4).
class FlowText {
 public:
  FlowText(std::string_view text, std::size_t begin) : text_(text), at_(begin) {}

  std::size_t at() const { return at_; }
  bool is_at(char c) const { return at_ < text_.size() && text_[at_] == c; }
  bool at_close() const { return at_ >= text_.size() || is_one_of(text_[at_], "]}"); }
  void step() { ++at_; }

  /// Over blanks and comments.
  void skip_blanks() {
    while (at_ < text_.size() && (is_one_of(text_[at_], kBlanks) || is_at('#'))) {
      at_ = is_at('#') ? std::min(text_.find('\n', at_), text_.size()) : at_ + 1;
    }
  }
  /// Over one item, with the blanks behind it. \return where it ends.
  std::size_t skip_item() {
    std::size_t end = at_;
    while (!is_at(',') && !at_close()) {
      skip_piece();
      end = at_;
      skip_blanks();
    }
    return end;
  }

 private:
  void skip_piece() {
    const char first = text_[at_];
    if (is_one_of(first, "[{")) return skip_collection();
    if (is_one_of(first, "\"'")) return skip_quoted(first);
    if (first == ':') return step();
    // Words with blanks between them are one text, in which quotes are characters as others are.
    for (; at_ < text_.size() && !is_one_of(text_[at_], kMarks); ++at_) {
      const char next = at_ + 1 < text_.size() ? text_[at_ + 1] : '\n';
      if (text_[at_] == ':' && (is_one_of(next, kBlanks) || is_one_of(next, kMarks))) break;
      if (is_one_of(text_[at_], kBlanks) && next == '#') break;
    }
    while (is_one_of(text_[at_ - 1], kBlanks)) --at_;
  }
  void skip_collection() {
    for (step(), skip_blanks(); !at_close(); skip_blanks()) {
      if (is_at(',')) step();
      skip_blanks();
      skip_item();
    }
    step();
  }
  void skip_quoted(char quote) {
    for (step(); at_ < text_.size(); step()) {
      const bool doubled = quote == '\'' && text_.substr(at_).starts_with("''");
      if (doubled || (quote == '"' && is_at('\\'))) {
        step();
      } else if (is_at(quote)) {
        return step();
      }
    }
  }

  std::string_view text_;
  std::size_t at_;
};

std::size_t line_begin(std::string_view text, std::size_t at) {
  const std::size_t before = at == 0 ? text.npos : text.rfind('\n', at - 1);
  return before == text.npos ? 0 : before + 1;
}

/// Lines one below the other from a column on; the first is there already.
std::string set_at(const std::vector<std::string>& lines, std::size_t column) {
  return join(lines, concat('\n', std::string(column, ' ')));
}

}  // namespace

FlowList find_flow_list(std::string_view text, std::size_t begin) {
  FlowList list;
  list.begin = begin;
  FlowText flow(text, begin + 1);
  for (flow.skip_blanks(); !flow.at_close(); flow.skip_blanks()) {
    if (flow.is_at(',')) {
      flow.step();
      list.last_comma = flow.at();
      continue;
    }
    const std::size_t at = flow.at();
    list.items.push_back({at, flow.skip_item()});
    list.last_comma = 0;
  }
  list.end = flow.at() + 1;
  return list;
}

std::string with_item(std::string_view text, const FlowList& list,
                      const std::vector<std::string>& item) {
  if (list.items.empty()) {
    const std::size_t close = list.end - 1, line = line_begin(text, close);
    const bool alone = line > list.begin;  // comments may stand above it
    const std::size_t column = close - line + 2;
    const std::string added =
        alone ? concat("  ", set_at(item, column), '\n', std::string(column - 2, ' '))
              : set_at(item, close - line);
    return concat(text.substr(0, close), added, text.substr(close));
  }
  const FlowList::Item& last = list.items.back();
  const std::size_t line = line_begin(text, last.begin), column = last.begin - line;
  const bool own_line = line > list.begin && text.find_first_not_of(' ', line) == last.begin;
  const std::string_view comma = list.last_comma == 0 ? "," : "";
  const std::size_t after = list.last_comma == 0 ? last.end : list.last_comma;
  if (!own_line) {
    const std::size_t from = after - line_begin(text, after) + comma.size() + 1;
    return concat(text.substr(0, after), comma, ' ', set_at(item, from), text.substr(after));
  }
  // A comment behind the last item stays with it.
  std::size_t end = std::min(text.find('\n', after), text.size());
  if (end > list.end - 1) end = after;
  const std::string added = concat('\n', std::string(column, ' '), set_at(item, column));
  return concat(text.substr(0, last.end), comma, text.substr(last.end, end - last.end), added,
                text.substr(end));
}

std::string with_item_in_place(std::string_view text, const FlowList::Item& old,
                               const std::vector<std::string>& item) {
  const std::size_t column = old.begin - line_begin(text, old.begin);
  return concat(text.substr(0, old.begin), set_at(item, column), text.substr(old.end));
}

}  // namespace crowdface
