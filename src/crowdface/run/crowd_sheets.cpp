// SPDX-License-Identifier: Apache-2.0
#include "crowdface/run/crowd_sheets.h"

#include "crowdface/core/error.h"
#include "crowdface/core/interrupt.h"
#include "crowdface/core/log.h"
#include "crowdface/core/parallel.h"
#include "crowdface/core/progress.h"
#include "crowdface/core/result_versions.h"
#include "crowdface/core/text.h"
#include "crowdface/crowd/crowd_lock.h"
#include "crowdface/crowd/face_mesh.h"
#include "crowdface/crowd/likeness_file.h"
#include "crowdface/heads/face_attachments.h"
#include "crowdface/heads/face_shapes.h"
#include "crowdface/heads/face_textures.h"
#include "crowdface/pictures/gallery_page.h"
#include "crowdface/run/face_builder.h"
#include "crowdface/run/face_finisher.h"
#include "crowdface/run/face_ledger.h"
#include "crowdface/run/head_traits.h"
#include "crowdface/run/output_check.h"
#include "crowdface/run/planned.h"
#include "crowdface/run/report.h"
#include "crowdface/run/resume.h"

namespace crowdface {

namespace fs = std::filesystem;

namespace {

const std::string kItem{kSheetsItem};

std::vector<std::string> sheet_files(const CrowdDirectory& directory, const WrittenSheets& sheets) {
  std::vector<std::string> names;
  for (const fs::path& path : picture_files(directory, sheets)) {
    names.push_back(directory.relative(path));
  }
  return names;
}

void write_founders(const std::vector<FacePlan>& founders, const FaceBuilder& builder,
                    const CrowdPictures& pictures) {
  for (const FacePlan& founder : founders) {
    throw_if_interrupted();
    pictures.write_founder(*founder.family, builder.build(founder.recipe), founder.recipe);
  }
}

/// Adds a text to a hash in pieces, with the same result as adding the whole text at once.
void add_text(const TextPieces& text, Hasher& hasher) {
  hasher.add(digest_of(text).bytes);
  text([&](std::string_view piece) { hasher.add_raw(piece); });
}

/// Hash of everything that the contact sheets and the gallery show.
Digest key_of_sheets(const Job& job, const CrowdDirectory& directory, const CrowdPlan& crowd_plan,
                     const CrowdLikeness& likeness, const std::vector<FaceResult>& faces) {
  Hasher hasher;
  hasher.add(kSheetVersion).add(job.settings);
  for (const auto& [name, digest] : digests_without_heads_and_masks(job.inputs)) {
    hasher.add(name).add(digest);
  }
  hasher.add(stored_config_text(job.config, directory)).add(gallery_page_digest(job.config));
  // Hash the plan (with each face's notes) and the content of likeness.json. The reviews and the
  // distance mask need no hash of their own: they change the sheets only through these two files.
  try {
    add_text([&](const TextSink& take) { read_pieces(directory.plan(), take); }, hasher);
  } catch (const MissingInput& error) {  // another program has removed the plan
    throw IoError(error.what());
  }
  hasher.add(whole_text(plan_text(crowd_plan.founders, job.names, job.settings)));
  std::vector<std::string> ids;
  for (std::size_t i = 0; i < crowd_plan.crowd.size(); ++i) {
    ids.push_back(crowd_plan.crowd[i].id);
    for (const FileDigest& file : faces[i].file_digests) hasher.add(file.digest);
  }
  add_text(likeness_text(likeness, job.names, ids), hasher);
  return hasher.digest();
}

/// Faces whose images are missing or out of date.
std::vector<FacePlan> faces_to_render(const FaceLedger& ledger,
                                      const std::vector<FacePlan>& crowd) {
  std::vector<FacePlan> faces;
  for (const std::size_t f : find_done_faces(ledger, crowd, Shard()).missing_faces)
    faces.push_back(crowd[f]);
  return faces;
}

/// Reads the faces' mesh files, renders the faces, and makes their small meshes for the gallery.
void render_faces(const Job& job, const FaceFileLists& lists, const std::vector<FacePlan>& faces,
                  const FaceTextures& textures, const FaceShapes& shapes,
                  const CrowdRenders& renders) {
  const FaceAttachments attachments(job.config, job.inputs, faces);
  const FaceFinisher finisher{textures, attachments, shapes, nullptr, &renders};
  std::vector<const FacePlan*> all;
  for (const FacePlan& face : faces) all.push_back(&face);
  lists.make_folders(all);
  StageTimes busy;
  Progress progress("pictures", faces.size());
  parallel_for_each(faces.size(), [&](std::size_t i) {
    throw_if_interrupted();
    const Positions positions =
        read_face_positions(lists.directory(), faces[i].id, job.config.output.meshes,
                            job.inputs.head_set.topology.vertex_count);
    FinishedFace face(faces[i], positions);
    finisher.finish(face, busy);
    write_files_of(face, lists.shown_files(faces[i]));
    progress.step();
  });
}

}  // namespace

std::size_t make_sheets(const Job& job, const CrowdDirectory& directory,
                        const CrowdPlan& crowd_plan, const std::vector<FaceResult>& faces,
                        Lazy<FaceBuilder>& builder, Lazy<CrowdPictures>& pictures, Ledger& ledger) {
  const Config::ContactSheet& sheet = *job.config.output.contact_sheet;
  const std::vector<FacePlan>& crowd = crowd_plan.crowd;
  const CrowdLikeness likeness = crowd_likeness(crowd_plan.anchors, crowd_plan.points);
  const Digest key = key_of_sheets(job, directory, crowd_plan, likeness, faces);
  // If the faces are compared with a file, always make the sheets again, because the file may have
  // changed.
  const bool may_change = sheet.compare.reference == Config::MeshComparison::Reference::kFile;
  if (!may_change && ledger.find_verified(kItem, key)) return sheet_page_count(sheet, crowd.size());
  pictures.get().write_heads();
  pictures.get().set_head_traits(head_traits_of_config(job.config, job.inputs));
  if (!crowd_plan.founders.empty()) {
    write_founders(crowd_plan.founders, builder.get(), pictures.get());
  }
  builder.release();  // frees memory for the sheets
  const WrittenSheets sheets = pictures.get().write_sheets_and_gallery(crowd, likeness);
  std::vector<std::string> files = sheet_files(directory, sheets);
  if (!has_gallery(job.config)) {  // the ledger then removes the files of an earlier gallery
    const std::string folder = directory.relative(directory.gallery()) + '/';
    std::erase_if(files, [&](const std::string& file) { return file.starts_with(folder); });
  }
  ledger.record(kItem, key, files);
  return sheets.pages;
}

void remake_sheets(const fs::path& crowd_directory, const std::vector<std::string>& assignments,
                   const fs::path& cache) {
  CrowdDirectory directory{crowd_directory};
  require_crowd(directory);
  // lock the folder, so that no other run replaces the mesh files while this run reads them
  const CrowdLock lock(directory, {});
  ConfigOverrides overrides;
  overrides.assignments = assignments;
  const Job job = load_job(directory.config(), overrides, cache);
  directory.faces_per_folder = crowd_directory_of(job.config).faces_per_folder;
  if (!job.config.output.contact_sheet) {
    throw UsageError(concat(directory.config().string(),
                            ": this crowd has no contact sheet; ask for one with --set "
                            "output.contact_sheet='{columns: 6}'"));
  }
  check_crowd_directory(directory, crowd_config(job.config, directory), Replace::kForce);
  refuse_other_heads(job.settings, directory, Replace::kRefuse);
  refuse_other_inputs(job.inputs, directory);
  std::vector<FacePlan> crowd;
  std::vector<std::string> ids;
  for (PlanLine& line : read_plan(directory.plan(), job.names)) {
    ids.push_back(line.face.id);
    crowd.push_back(std::move(line.face));
  }
  if (crowd.empty()) return log_info("the crowd has no faces, so it gets no sheets");
  const CrowdLikeness likeness = read_likeness(directory.likeness(), job.names, ids);
  const FaceTextures textures(job.config, job.inputs);
  const FaceShapes shapes(job.config, job.inputs);
  CrowdPictures pictures(job.config, job.inputs, job.settings, directory, textures, shapes);
  pictures.write_heads();
  Ledger ledger(directory.root, directory.ledger(), directory.ledgers());
  const FaceFileLists lists(job.config, job.inputs, directory);
  render_faces(job, lists, faces_to_render(FaceLedger(ledger, job, lists, {}), crowd), textures,
               shapes, pictures.renders());
  const std::vector<FacePlan> founders = read_founders(job, directory);
  if (!founders.empty()) {
    const PreparedHeads prepared = prepare(job.config, job.inputs, job.smoothing, cache);
    write_founders(founders, FaceBuilder(job.config, job.inputs, prepared), pictures);
  }
  pictures.set_head_traits(head_traits_of_config(job.config, job.inputs));
  const WrittenSheets sheets = pictures.write_sheets_and_gallery(crowd, likeness);
  ledger.record_remade_files(kItem, sheet_files(directory, sheets), {"renders", "gallery"});
  lock.require_same_folder();
  log_info(concat(sheets.pages, sheets.pages == 1 ? " sheet" : " sheets", " in ",
                  directory.sheets().string()));
}

}  // namespace crowdface
