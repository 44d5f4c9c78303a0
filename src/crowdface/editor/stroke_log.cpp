// SPDX-License-Identifier: Apache-2.0
#include "crowdface/editor/stroke_log.h"

#include <sstream>
#include <string>

#include "crowdface/core/file.h"
#include "crowdface/core/log.h"
#include "crowdface/core/text.h"
#include "crowdface/io/shallow_json.h"

namespace crowdface {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kPaintedOn = "painted_on";

}  // namespace

StrokeLog::StrokeLog(std::filesystem::path file, const Digest& preview_digest)
    : file_(std::move(file)), preview_digest_(preview_digest) {
  if (!path_exists(file_)) return;
  std::istringstream lines(read_file(file_));
  bool known = false;
  for (std::string line; std::getline(lines, line) && !lines.eof();) {
    Json stroke = parse_shallow_json(line);
    if (!stroke.is_object()) break;
    if (known) {
      strokes_.push_back(std::move(stroke));
      continue;
    }
    known = stroke.contains(kPaintedOn) && stroke[kPaintedOn] == preview_digest_.hex();
    if (!known) break;
  }
  if (!known) {
    log_info(concat(file_.string(), ": its strokes were painted on other masks and are discarded"));
    remove_if_exists(file_);
  } else {
    log_info(concat(file_.string(), ": unsaved strokes painted again: ", strokes_.size()));
  }
}

void StrokeLog::add(const Json& stroke) {
  std::string lines;
  if (!append_file_) {
    // Rewrite the whole file, because the last line of the file may be incomplete.
    lines = Json({{kPaintedOn, preview_digest_.hex()}}).dump() + '\n';
    for (const Json& before : strokes_) lines += before.dump() + '\n';
    write_file(file_, lines);
    append_file_ = std::make_unique<AppendFile>(file_);
  }
  try {
    append_file_->append(stroke.dump() + '\n');
  } catch (...) {  // the file may hold a part of the line; the next stroke rewrites the file
    append_file_.reset();
    throw;
  }
  strokes_.push_back(stroke);
}

void StrokeLog::clear() {
  append_file_.reset();
  strokes_.clear();
  remove_if_exists(file_);
}

}  // namespace crowdface
