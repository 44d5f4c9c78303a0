// SPDX-License-Identifier: Apache-2.0
#include "crowdface/config/yaml.h"

#include <array>
#include <sstream>
#include <unordered_map>
#include <utility>

#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/parser.h>

#include "crowdface/config/yaml_text.h"
#include "crowdface/core/input_limits.h"
#include "crowdface/core/text.h"
#include "crowdface/io/legacy_text.h"

namespace crowdface {
namespace {

constexpr std::size_t kMaxNodes = 100'000;
// largest number of complaints for each file; a longer list would hide the first problems
constexpr std::size_t kMaxComplaints = 50;
// longer paths of keys are cut to this length, in bytes; limits the length of messages, and the
// memory that a malicious file can use
constexpr std::size_t kMaxPath = 120;

/// Exception that ends the parsing of a file, after a complaint was added.
struct Stop {};

/// Builds a tree of YamlNodes from the events that yaml-cpp reports.
class TreeBuilder : public YAML::EventHandler {
 public:
  TreeBuilder(const YamlText& text, Complaints& out) : text_(text), out_(out) {}

  std::optional<YamlNode> root() { return std::move(root_); }

  void OnDocumentStart(const YAML::Mark& mark) override {
    if (root_) {
      fail(place(mark),
           "a second document, or text after the end of the first; expected one document");
    }
  }
  void OnDocumentEnd() override {}

  void OnNull(const YAML::Mark& mark, YAML::anchor_t /*anchor*/) override {
    YamlNode node = make(YamlNode::Kind::kNothing, mark);
    // yaml-cpp reports an empty value at the position of the next token. Instead, report the
    // position of the key (or the list) whose value is empty.
    if (!frames_.empty() && !expects_key()) {
      const Frame& frame = frames_.back();
      if (frame.node.kind == YamlNode::Kind::kMap) {
        node.place = frame.key_place;
      } else if (!text_.is_null_at(mark.line, mark.column)) {
        node.place = frame.node.place;
      }
    }
    attach(std::move(node));
  }

  void OnAlias(const YAML::Mark& mark, YAML::anchor_t /*anchor*/) override {
    complain(place(mark), "aliases (*) are not supported; write the value out");
    attach(make(YamlNode::Kind::kRefused, mark));
  }

  void OnAnchor(const YAML::Mark& mark, const std::string& name) override {
    complain(place(mark), concat("anchors (&", name,
                                 ") are not supported; write the value out where it is used"));
  }

  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t /*anchor*/,
                const std::string& value) override {
    refuse_tag(mark, tag);
    if (text_.is_unclosed_quote_at(mark.line, mark.column)) {
      fail(place(mark), "the quote opened here is never closed");
    }
    YamlNode node = make(YamlNode::Kind::kScalar, mark);
    node.text = value;
    node.is_quoted = tag == "!";
    attach(std::move(node));
  }

  void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t /*anchor*/,
                       YAML::EmitterStyle::value /*style*/) override {
    refuse_tag(mark, tag);
    open(YamlNode::Kind::kList, mark);
  }
  void OnSequenceEnd() override { close(); }

  void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t /*anchor*/,
                  YAML::EmitterStyle::value /*style*/) override {
    refuse_tag(mark, tag);
    open(YamlNode::Kind::kMap, mark);
  }
  void OnMapEnd() override { close(); }

  YamlPlace place(const YAML::Mark& mark) const { return text_.place(mark.line, mark.column); }

  void complain(const YamlPlace& where, const std::string& what) {
    out_.add(where, what);
    if (++complaints_ >= kMaxComplaints) {
      out_.add(where, "too many problems; stopped here");
      throw Stop{};
    }
  }

  [[noreturn]] void fail(const YamlPlace& where, const std::string& what) {
    complain(where, what);
    throw Stop{};
  }

 private:
  /// A list or mapping whose end has not been reached yet.
  struct Frame {
    YamlNode node;
    bool has_key = false;
    bool key_refused = false;
    std::string key;
    YamlPlace key_place;
    /// for each key so far, the line in which the key occurs
    std::unordered_map<std::string, int> lines;
  };

  bool expects_key() const {
    return frames_.back().node.kind == YamlNode::Kind::kMap && !frames_.back().has_key;
  }

  YamlNode make(YamlNode::Kind kind, const YAML::Mark& mark) {
    YamlNode node;
    node.kind = kind;
    node.place = place(mark);
    if (++nodes_ > kMaxNodes) {
      fail(node.place, concat("expected at most ", kMaxNodes,
                              " values in one file; split the file, or check that it is a config"));
    }
    if (!frames_.empty() && !expects_key()) node.path = child_path(frames_.back());
    return node;
  }

  static std::string child_path(const Frame& frame) {
    std::string path = frame.node.path;
    if (frame.node.kind == YamlNode::Kind::kList) {
      path += concat(path.empty() ? "#" : " #", frame.node.items.size() + 1);
    } else {
      if (!path.empty()) path += '.';
      path += frame.key;
    }
    if (path.size() > kMaxPath) path = path.substr(0, kMaxPath) + "…";
    return path;
  }

  void refuse_tag(const YAML::Mark& mark, const std::string& tag) {
    if (tag.empty() || tag == "?" || tag == "!") return;
    complain(place(mark), concat("tags (", quoted(tag), ") are not supported; leave the tag out"));
  }

  void open(YamlNode::Kind kind, const YAML::Mark& mark) {
    Frame frame;
    frame.node = make(kind, mark);
    const std::uint64_t most = input_limits().yaml_depth;
    if (frames_.size() >= most) {
      fail(frame.node.place, concat("expected at most ", most,
                                    " levels of nesting (--limit yaml_depth=NUMBER allows more)"));
    }
    frames_.push_back(std::move(frame));
  }

  void close() {
    YamlNode node = std::move(frames_.back().node);
    frames_.pop_back();
    attach(std::move(node));
  }

  void attach(YamlNode node) {
    if (frames_.empty()) {
      root_ = std::move(node);
    } else if (frames_.back().node.kind == YamlNode::Kind::kList) {
      frames_.back().node.items.push_back(std::move(node));
    } else if (expects_key()) {
      take_key(node);
    } else {
      take_value(std::move(node));
    }
  }

  void take_key(const YamlNode& node) {
    Frame& frame = frames_.back();
    frame.has_key = true;
    frame.key_refused = true;
    frame.key = node.text;
    frame.key_place = node.place;
    if (node.kind == YamlNode::Kind::kRefused) return;
    if (node.kind != YamlNode::Kind::kScalar || node.text.empty()) {
      complain(node.place, concat("expected a key, found ", describe(node)));
      return;
    }
    if (node.text == "<<" && !node.is_quoted) {
      complain(node.place, "merge keys (<<) are not supported; write the keys out");
      return;
    }
    const auto [seen, is_new] = frame.lines.emplace(node.text, node.place.line);
    if (!is_new) {
      complain(node.place, concat("the key ", quoted(node.text), " is used twice; first ",
                                  "in line ", seen->second));
      return;
    }
    frame.key_refused = false;
  }

  void take_value(YamlNode node) {
    Frame& frame = frames_.back();
    frame.has_key = false;
    if (frame.key_refused) return;
    frame.node.entries.push_back({std::move(frame.key), frame.key_place, std::move(node)});
  }

  const YamlText& text_;
  Complaints& out_;
  std::optional<YamlNode> root_;
  std::vector<Frame> frames_;
  std::size_t nodes_ = 0;
  std::size_t complaints_ = 0;
};

/// Translates yaml-cpp's message for a syntax error into plain words.
std::string explain(const std::string& message) {
  struct Entry {
    std::string_view theirs, ours;  ///< start of yaml-cpp's message, and the text to show instead
  };
  static constexpr std::array kEntries = {
      Entry{"illegal map value",
            "a ':' does not fit here; check the indentation, and the lines above for a missing "
            "':', or put text that holds ': ' between quotes"},
      Entry{
          "end of map not found",
          "the indentation of this line matches no line above it, or the line is not 'key: value'"},
      Entry{"end of sequence not found",
            "the indentation of this line matches no item of the list above it"},
      Entry{"illegal block entry", "a list item '-' does not fit here; check the indentation"},
      Entry{"end of sequence flow not found", "a '[' is not closed"},
      Entry{"end of map flow not found", "a '{' is not closed"},
      Entry{"illegal flow end", "a ']' or '}' has no opening bracket"},
      Entry{"unknown token", "a value cannot start with this character; put it between quotes"},
      Entry{"bad character found while scanning hex number",
            "between double quotes '\\' begins an escape; write paths with / instead of \\"},
      Entry{"unknown escape character",
            "between double quotes '\\' begins an escape; write paths with / instead of \\"},
      Entry{"the referenced anchor is not defined",
            "aliases (*) are not supported; put text that starts with '*' between quotes"},
  };
  for (const Entry& entry : kEntries) {
    if (message.starts_with(entry.theirs)) return std::string(entry.ours);
  }
  return concat("this is not valid YAML: ", message);
}

}  // namespace

std::optional<YamlNode> parse_yaml(std::string_view text, const std::string& source,
                                   Complaints& out) {
  // A text that is too long or is invalid UTF-16 stays as it is, so that find_problem reports it.
  std::string plain;
  if (text.size() <= input_limits().yaml_bytes) plain = plain_text(text);
  const YamlText checked(plain.empty() ? text : plain, source);
  if (const auto problem = checked.find_problem()) {
    out.add(problem->place, problem->message);
    return std::nullopt;
  }
  TreeBuilder builder(checked, out);
  try {
    std::istringstream stream{std::string(checked.text())};
    YAML::Parser parser(stream);
    while (parser.HandleNextDocument(builder)) {
    }
  } catch (const YAML::Exception& error) {
    out.add(builder.place(error.mark), explain(error.msg));
    return std::nullopt;
  } catch (const Stop&) {
    return std::nullopt;
  }
  auto root = builder.root();
  if (!root) out.add(checked.place(0, 0), "expected a value, found nothing");
  return root;
}

}  // namespace crowdface
