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

#include "crowdface/core/file.h"
#include "crowdface/io/encoded_file.h"
#include "crowdface/run/face_ledger.h"

namespace crowdface {

/// An encoded file of a face and its path.
struct ReadyFile {
  std::filesystem::path path;
  EncodedFile bytes;
  FileDigest digest;  ///< size and hash of `bytes`
};

/// Writes the files of faces on a separate thread, so that computing threads need not wait for the
/// disk. Faces that arrive while one batch is written form the next batch. Each batch needs only
/// one sync to disk and one write to the ledger. A file that already has the right content is not
/// written again.
class FaceWriter {
 public:
  /// \param ledger         must outlive this object.
  /// \param max_waiting_bytes  maximum total size of the files that wait to be written. A single
  /// face may exceed this size.
  /// \param on_recorded    called after each recorded face
  FaceWriter(const FaceLedger& ledger, std::uint64_t max_waiting_bytes,
             std::function<void()> on_recorded);
  ~FaceWriter();  ///< drops files whose writing has not begun
  FaceWriter(const FaceWriter&) = delete;
  FaceWriter& operator=(const FaceWriter&) = delete;

  /// Adds a face to the queue of faces to write; waits while the queue is full. Thread-safe.
  /// \throws the exception of a failed write; after a failure no further face is written.
  void add(MadeFace face, std::vector<ReadyFile> files);
  /// Waits until all faces are written and recorded. \throws the exception of a failed write.
  void finish();

  /// Time that the writing thread has spent writing files.
  double busy_seconds() const { return busy_seconds_; }
  /// Smallest useful size of the queue, in bytes: with a smaller queue, computing threads wait for
  /// the disk.
  static constexpr std::uint64_t kMinWaitingBytes = std::uint64_t{64} << 20U;
  /// Largest useful size of the queue, in bytes: keeps the disk busy while a group of faces is
  /// blended.
  static constexpr std::uint64_t kMaxWaitingBytes = std::uint64_t{256} << 20U;

 private:
  /// Faces that the writing thread writes and records together.
  struct Batch {
    std::vector<MadeFace> faces;
    std::vector<ReadyFile> files;  ///< the files of all `faces`
    std::uint64_t bytes = 0;       ///< memory of the encoded files, in bytes
  };

  /// Main function of the writing thread.
  void run();
  /// Writes the files of a batch, and then records its faces.
  void write(const Batch& batch);

  const FaceLedger& ledger_;
  std::uint64_t max_waiting_bytes_;
  std::function<void()> on_recorded_;
  std::mutex mutex_;
  /// notified when `waiting_`, `is_writing_`, `is_closing_` or `error_` changes
  std::condition_variable changed_;
  Batch waiting_;             ///< faces and files that wait to be written
  bool is_writing_ = false;   ///< whether the writing thread is writing a batch
  bool is_closing_ = false;   ///< whether the destructor has been called
  std::exception_ptr error_;  ///< the exception of a failed write
  double busy_seconds_ = 0;
  std::thread thread_;  // declared last, because the thread uses the other members
};

}  // namespace crowdface
