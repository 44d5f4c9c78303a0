// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

#include "crowdface/io/encoded_file.h"
#include "crowdface/run/face_ledger.h"

namespace crowdface {

/// What a file of a face holds, and where it goes.
struct ReadyFile {
  std::filesystem::path path;
  EncodedFile bytes;
};

/// Writes faces on a thread of its own, so that those that compute wait for no disk. What became ready while it was at
/// work is written together, synced once, and then recorded.
class FaceWriter {
 public:
  /// \param ledger    must outlive this object.
  /// \param waiting_bytes  what waits to be written takes at most, if it is more than one face.
  /// \param recorded  called after each face that is.
  FaceWriter(const FaceLedger& ledger, std::uint64_t waiting_bytes, std::function<void()> recorded);
  ~FaceWriter();  ///< what was not begun is dropped
  FaceWriter(const FaceWriter&) = delete;
  FaceWriter& operator=(const FaceWriter&) = delete;

  /// From any thread; waits while much waits to be written.
  /// \throws what writing threw; then nothing more is written.
  void add(MadeFace face, std::vector<ReadyFile> files);
  /// Returns when all faces are written and recorded. \throws what writing threw.
  void finish();

  /// How long the thread was at work.
  double busy_seconds() const { return busy_seconds_; }
  /// What should be allowed to wait, so that threads do not wait for the disk.
  static constexpr std::uint64_t kLeastWaitingBytes = std::uint64_t{64} << 20U;
  /// So much keeps the disk busy while a group of faces is blended.
  static constexpr std::uint64_t kMostWaitingBytes = std::uint64_t{256} << 20U;

 private:
  struct Waiting {
    std::vector<MadeFace> faces;
    std::vector<ReadyFile> files;
    std::uint64_t bytes = 0;
  };

  void run();
  void write(const Waiting& some);

  const FaceLedger& ledger_;
  std::uint64_t waiting_bytes_;
  std::function<void()> recorded_;
  std::mutex mutex_;
  std::condition_variable changed_;
  Waiting waiting_;
  bool is_at_work_ = false, is_closing_ = false;
  std::exception_ptr error_;
  double busy_seconds_ = 0;
  std::thread thread_;  // after all that it uses
};

}  // namespace crowdface
