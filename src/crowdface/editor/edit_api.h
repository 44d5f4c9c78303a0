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

#include "crowdface/editor/dropped_files.h"
#include "crowdface/editor/edit_attachments.h"
#include "crowdface/editor/edit_expressions.h"
#include "crowdface/editor/edit_pictures.h"
#include "crowdface/editor/edit_session.h"
#include "crowdface/editor/edited_folder.h"
#include "crowdface/editor/generate_run.h"
#include "crowdface/editor/region_painting.h"
#include "crowdface/page/answer_request.h"
#include "crowdface/page/local_server.h"

namespace crowdface {

/// Answers the HTTP requests of the editor's page (docs/editor.md).
class EditApi {
 public:
  /// \param session, folder, run  must outlive this object
  /// \param may_edit_config  whether requests may save recipes and regions to the job's config;
  ///                         true if the config is the user's own file, not the config.yaml in a
  ///                         crowd's folder
  /// \param reload_job  reloads the config and the crowd, and replaces this object by a new EditApi
  EditApi(EditSession& session, EditedFolder& folder, GenerateRun& run, bool may_edit_config,
          std::function<void()> reload_job);

  /// Never throws because of the content of a request: the answer to a faulty request is {"error":
  /// sentence}.
  HttpAnswer answer(const HttpRequest& request);

 private:
  using Json = nlohmann::ordered_json;
  /// \param rest  the part of the request's path after the route; empty unless the route ends in
  ///              '/'
  using Handler = HttpAnswer(const HttpRequest& request, const std::string& rest);

  /// Handlers of requests about the job and its faces.
  Handler job, mesh, light, head, attachment, face, skin, measures, faults, draw, steer,
      face_picture;
  /// Handlers of requests that save the editor's state or write other files.
  Handler saved_state, take_over_editing, save_state, save_face, put_recipe, review;
  /// Handlers of requests that generate the crowd and load the result.
  Handler generate, stop_generate, generate_progress, reload_job;
  /// Handlers of requests that paint masks.
  Handler paint_masks, undo_masks, save_masks, use_regions;
  /// Handlers of requests that add heads.
  Handler begin_drop, receive_dropped_file, add_heads;
  /// The answer to requests that paint: the painted masks.
  HttpAnswer painted_masks() const;
  /// Returns a function that builds a face and writes its mesh.
  EditedFolder::WriteMesh mesh_writer();
  /// Returns a path for new masks at which no file exists yet. Files of earlier masks are not
  /// overwritten, so that the user can undo steps.
  std::filesystem::path unused_mask_path() const;
  /// \throws UsageError if the painted masks differ from the config's masks. A saved face would
  ///         otherwise not match the config.
  void require_masks_of_config() const;
  /// \throws UsageError if the job was opened from a crowd's folder, whose config records how the
  ///         crowd was made and must not change.
  void require_editable_config() const;
  /// \throws UsageError while `crowdface generate` is running.
  void require_no_run();

  /// Reads a list of bands from the value that the body of a request has at `key`.
  /// \return band indices as in ReviewMark::locked_bands
  /// \throws UsageError with the name of the key if the value is not valid.
  std::vector<std::size_t> bands_in(const Json& body, const std::string& key) const;
  /// Reads the face that a key in the body of a request contains.
  /// \throws UsageError as bands_in does.
  FacePlan face_in(const Json& body, const std::string& key = "recipe") const;
  /// Reads the id of the crowd's face from which the user began the edit; empty if there is none.
  static std::string opened_id(const Json& body);

  /// Returns the result of section_in_edits as a JSON string, or null.
  static Json edit_json(const std::filesystem::path& edits, const std::string& section);
  Json measures_json(const FaceMeasures& measures) const;
  /// Stores the number of a request, if it is the largest number that the page has sent.
  void note_request_number(const std::string& page, std::uint64_t request_number);
  /// Returns whether the page has sent a request with a larger number.
  bool is_outdated_request(const std::string& page, std::uint64_t request_number);

  const EditSession& session_;
  bool may_edit_config_;  ///< whether requests may save recipes and regions to the job's config
  EditedFolder& folder_;
  GenerateRun& run_;
  std::function<void()> reload_job_;  ///< reloads the job and replaces this object
  PageFiles page_;                    ///< HTML, script and style of the page
  EditPictures pictures_;
  EditAttachments attachments_;
  EditExpressions expressions_;
  DroppedFiles dropped_;     ///< files that the user drags from the desktop and drops on the page
  RegionPainting painting_;  ///< the painted regions of the job; guarded by `build_mutex_`
  std::mutex build_mutex_;   ///< locked during a build of a face, which uses all cores
  /// Number of sampling attempts so far; each request continues from this number, so that it
  /// samples other faces.
  std::atomic<std::uint32_t> sampling_attempts_ = 0;
  std::mutex newest_requests_mutex_;  ///< guards `newest_requests_`
  /// maps the id of a page to the number of the page's newest request
  std::map<std::string, std::uint64_t> newest_requests_;
};

}  // namespace crowdface
