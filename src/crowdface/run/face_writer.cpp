// SPDX-License-Identifier: Apache-2.0
#include "crowdface/run/face_writer.h"

#include <chrono>
#include <iterator>
#include <utility>

#include "crowdface/core/file.h"

namespace crowdface {
namespace {

/// Maximum number of files written together: the number of open file descriptors is limited.
constexpr std::size_t kMaxFiles = 200;

}  // namespace

FaceWriter::FaceWriter(const FaceLedger& ledger, std::uint64_t max_waiting_bytes,
                       std::function<void()> on_recorded)
    : ledger_(ledger),
      max_waiting_bytes_(max_waiting_bytes),
      on_recorded_(std::move(on_recorded)),
      thread_([this] { run(); }) {}

FaceWriter::~FaceWriter() {
  {
    const std::lock_guard lock(mutex_);
    is_closing_ = true;
    waiting_ = {};
  }
  changed_.notify_all();
  thread_.join();
}

void FaceWriter::add(MadeFace face, std::vector<ReadyFile> files) {
  std::uint64_t bytes = 0;
  for (const ReadyFile& file : files) bytes += file.bytes.memory_bytes();
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] {
    return error_ != nullptr || waiting_.faces.empty() ||
           (waiting_.bytes + bytes <= max_waiting_bytes_ && waiting_.files.size() < kMaxFiles);
  });
  if (error_) std::rethrow_exception(error_);
  waiting_.faces.push_back(std::move(face));
  std::move(files.begin(), files.end(), std::back_inserter(waiting_.files));
  waiting_.bytes += bytes;
  changed_.notify_all();
}

void FaceWriter::finish() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock,
                [&] { return error_ != nullptr || (waiting_.faces.empty() && !is_writing_); });
  if (error_) std::rethrow_exception(error_);
}

void FaceWriter::run() {
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [&] { return is_closing_ || !waiting_.faces.empty(); });
    if (waiting_.faces.empty()) return;
    Batch batch = std::exchange(waiting_, {});
    is_writing_ = true;
    changed_.notify_all();
    lock.unlock();
    const auto start = std::chrono::steady_clock::now();
    std::exception_ptr error;
    try {
      write(batch);
    } catch (...) {
      error = std::current_exception();
    }
    batch = {};
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
    lock.lock();
    busy_seconds_ += took.count();
    is_writing_ = false;
    error_ = error;
    changed_.notify_all();
    if (error_) return;
  }
}

void FaceWriter::write(const Batch& batch) {
  std::vector<FileToWrite> files;
  for (const ReadyFile& file : batch.files) {
    if (has_content(file.path, file.digest)) continue;  // an earlier run has written this file
    files.push_back({file.path, file.bytes.pieces()});
    if (files.size() < kMaxFiles) continue;
    write_files(files);
    files.clear();
  }
  write_files(files);
  ledger_.record(batch.faces);
  for (std::size_t f = 0; f < batch.faces.size(); ++f) on_recorded_();
}

}  // namespace crowdface
