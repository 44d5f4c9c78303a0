// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "crowdface/editor/edit_pictures.h"
#include "crowdface/editor/edit_session.h"
#include "crowdface/editor/edit_worn.h"
#include "crowdface/editor/edited_folder.h"
#include "crowdface/editor/generate_run.h"
#include "crowdface/editor/region_painting.h"
#include "crowdface/page/answer_request.h"
#include "crowdface/page/local_server.h"

namespace crowdface {

/// What the editor's page asks for, answered (docs/editor.md).
class EditApi {
 public:
  /// \param session, folder, run  must outlive this object
  /// \param may_edit_config  whether recipes and regions may be put into the job's config: it is the
  ///                         user's own
  /// \param open_again  opens config and crowd as they stand now; from then on another object answers
  EditApi(EditSession& session, EditedFolder& folder, GenerateRun& run, bool may_edit_config,
          std::function<void()> open_again);

  /// Never throws for what a request holds: mistakes are answers, {"error": sentence}.
  HttpAnswer answer(const HttpRequest& request);

 private:
  using Json = nlohmann::ordered_json;
  /// \param rest  what follows the route's address, if that ends in '/'.
  using Handler = HttpAnswer(const HttpRequest& request, const std::string& rest);

  // About the job and its faces.
  Handler job, mesh, head, attachment, face, measures, draw;
  // What is kept or written.
  Handler state, keep_state, save, picture, put_recipe, review;
  Handler generate, stop_generate, generate_progress, open_again;
  // What is painted.
  Handler paint_masks, undo_masks, save_masks, use_regions;
  HttpAnswer painted_masks() const;
  EditedFolder::WriteMesh mesh_writer();
  /// Where masks can be written beside those that the config names.
  std::filesystem::path unused_masks() const;
  void require_masks_of_config() const;
  void require_own_config() const;
  void require_no_run();

  // What a request's body holds. \throws UsageError with the key's name.
  std::vector<std::size_t> parts_in(const Json& body, const std::string& key) const;
  CastFace face_of(const Json& body, const std::string& key = "recipe") const;
  Json told(const FaceMeasures& measures) const;
  void note_turn(const std::string& page, std::uint64_t turn);
  bool overtaken(const std::string& page, std::uint64_t turn);

  const EditSession& session_;
  bool may_edit_config_;
  EditedFolder& folder_;
  GenerateRun& run_;
  std::function<void()> open_again_;
  PageFiles page_;
  EditPictures pictures_;
  EditWorn worn_;
  RegionPainting painting_;               ///< under `building_`
  std::mutex building_;                   ///< one face at a time, by all cores
  std::atomic<std::uint32_t> draws_ = 0;  ///< attempts so far, so that each draw is another
  std::mutex turns_mutex_;
  std::map<std::string, std::uint64_t> turns_;  ///< the newest of each page
};

}  // namespace crowdface
