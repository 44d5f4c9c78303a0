// SPDX-License-Identifier: Apache-2.0
#include "crowdface/run/shard_progress.h"

#include <array>
#include <exception>

#include <unistd.h>

#include "crowdface/core/file.h"
#include "crowdface/core/log.h"
#include "crowdface/core/text.h"

namespace crowdface {
namespace {

std::string machine_name() {
  std::array<char, 256> name = {};
  return ::gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "";
}

}  // namespace

ShardProgress::ShardProgress(std::filesystem::path file, std::size_t face_count,
                             std::size_t finished_face_count)
    : file_(std::move(file)) {
  notes_.face_count = face_count;
  notes_.finished_face_count = finished_face_count;
  notes_.machine = machine_name();
  write();
}

void ShardProgress::step() {
  constexpr std::chrono::seconds kBetween(5);
  const std::lock_guard lock(mutex_);
  ++notes_.finished_face_count;
  ++notes_.made_face_count;
  if (Clock::now() - last_write_ >= kBetween) write();
}

void ShardProgress::end(ShardState state, std::string_view reason) {
  const std::lock_guard lock(mutex_);
  notes_.state = state;
  notes_.reason = reason;
  write();
}

void ShardProgress::write() noexcept {
  last_write_ = Clock::now();
  notes_.seconds = std::chrono::duration<double>(last_write_ - start_).count();
  try {
    write_file(file_, format_shard_notes(notes_));
  } catch (const std::exception& error) {
    log_debug(concat("progress: ", error.what()));
  }
}

}  // namespace crowdface
