// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "crowdface/attach/attachment_move.h"
#include "crowdface/blend/normalization.h"
#include "crowdface/cast/attachment_item.h"
#include "crowdface/cast/diversity.h"
#include "crowdface/cast/face_area.h"
#include "crowdface/cast/family.h"
#include "crowdface/cast/plan_names.h"
#include "crowdface/cast/review.h"
#include "crowdface/cast/sampling.h"
#include "crowdface/core/units.h"
#include "crowdface/io/mesh_format.h"
#include "crowdface/parts/part_options.h"
#include "crowdface/plane/layout.h"
#include "crowdface/render/surface_kind.h"
#include "crowdface/render/view.h"
#include "crowdface/smooth/smoothing_operator.h"

namespace crowdface {

struct CellSize;  // render/contact_sheet.h

/// What to do about heads that do not stand in one frame.
enum class Align {
  kCheck,  ///< warn
  kRigid,  ///< move every head onto the first by its best rotation and translation
  kNone,   ///< neither
};

/// Whether a crowd gets a page to choose from.
enum class Gallery {
  kAuto,  ///< where there are pictures and the page was built
  kNone,
};

/// Whose textures a face wears: by the weights of its shape, or drawn apart from it.
enum class ColourWeights { kRecipe, kDrawn };

/// What colours faces have.
enum class TextureBlend {
  kAuto,    ///< each its own, blended from the heads', where these have different ones
  kTarget,  ///< those of their target
  kNone,    ///< none that pictures show; files are as with kTarget
};
/// A format that faces' own textures are written in.
enum class TextureFormat { kPng, kJpeg, kExr };
/// Whether pictures show textures.
enum class SheetTexture {
  kAuto,  ///< where there are any
  kYes,
  kNo,
};

/// How the levels of smoothing are represented.
enum class Levels {
  kBasis,  ///< fields fitted to each head, as many as a tolerance needs
  kExact,  ///< every level by the filter itself
  kCubic,  ///< the paper's cubic in L per vertex (§5.1)
};

/// How pictures show a material, in place of what its name speaks of.
struct SurfaceChoice {
  SurfaceKind kind = SurfaceKind::kSkin;
  std::optional<std::array<std::uint8_t, 3>> colour;  ///< sRGB; none: that of its kind
};

/// What stands under a picture, a line each.
enum class SheetLabel {
  kId,
  kFamily,
  kGroup,
  kTarget,
  kNearest,
  kNearestHead,
  kTags,
  kAttachments
};
/// How the faces follow each other on contact sheets.
enum class SheetOrder { kPlan, kFamily, kGroup, kLikeness };
enum class SheetFormat { kPng, kExr, kPdf };

/// A config file, read, checked and with every name resolved. Fields bear the names of their YAML
/// keys; docs/config.md explains each. Paths are absolute or relative to the working directory.
struct Config {
  std::filesystem::path file;  ///< where it was read from

  struct Crowd {
    std::string name;
    std::uint64_t count = 0;  ///< sampled faces; recipes come on top
    std::uint64_t seed = 1;
  } crowd;

  struct Faces {
    std::vector<std::filesystem::path> files;    ///< one a head, in the order of their indices
    std::vector<std::string> names;              ///< #heads, the files' names without ending
    LengthUnit units = LengthUnit::kCentimetre;  ///< required in the file: never guessed
    Axis up = {1, 1};
    Axis front = {2, 1};
    Align align = Align::kCheck;
    std::vector<std::vector<std::string>> tags;  ///< #heads
  } faces;

  struct Regions {
    std::vector<std::string> names;  ///< empty: the whole head as one region, called "all"
    std::vector<std::string> mask;   ///< image paths, may hold <UDIM>; channels in this order
  } regions;

  struct Smoothing {
    double max_size_mm = 240;
    std::optional<std::uint64_t> max_iterations;  ///< overrides max_size_mm
    Boundary boundary = Boundary::kFixed;
    OperatorKind operator_kind = OperatorKind::kUmbrella;  ///< key `operator`
    Levels levels = Levels::kBasis;
    double tolerance_mm = 0.05;  ///< of `levels: basis`, at any vertex and level
  } smoothing;

  struct Blending {
    Normalization normalization = Normalization::kPartition;
    Contacts contacts = Contacts::kAuto;  ///< lips, and other skin that nearly touches
  } blending;

  /// How eyes, teeth and lashes go along. Names are of materials, groups or "component N".
  struct Parts {
    bool follow = true;  ///< false: `parts: none`, all is blended as skin
    PartShape shape = PartShape::kTarget;
    std::vector<std::string> skin, rigid, bound;
    std::vector<std::vector<std::string>> together;  ///< each a rigid part
  } parts;

  /// Expressions, of a template or of each head, to be carried to every face.
  struct Shapes {
    std::filesystem::path neutral;    ///< of the template; empty: there is none
    std::filesystem::path directory;  ///< of the template's shapes
    std::filesystem::path heads;      ///< with a folder a head; empty: one set serves all
    std::vector<std::string> names;   ///< empty: there are no shapes
    std::vector<std::filesystem::path>
        files;  ///< #names, of the template; empty: it lacks that shape
    std::vector<std::vector<std::filesystem::path>> of_head;  ///< #heads by #names; likewise
  } shapes;

  std::filesystem::path points;  ///< that follow the face: a file; empty: none
  std::filesystem::path rig;     ///< joints and what is bound to them: a GLB file; empty: none

  /// Something that may sit on a head, in a mesh of its own.
  struct Attachment : AttachmentItem {
    std::filesystem::path file;
    AttachmentMove moves = AttachmentMove::kBend;
  };
  struct Attachments {
    /// What all were fitted to: a head, or a file in the heads' topology; neither: the mean of the heads.
    std::optional<Eigen::Index> head;
    std::filesystem::path file;
    std::vector<Attachment> items;
    std::map<std::string, double> none;    ///< by kind: the share of faces without one
    std::map<std::string, double> quotas;  ///< by kind, name or colour: of those who wear one
  } attachments;

  struct Textures {
    TextureBlend blend = TextureBlend::kAuto;
    std::optional<std::uint64_t> size;  ///< texels of the longer side; none: the largest head's
    std::vector<TextureFormat> formats = {TextureFormat::kPng};
    ColourWeights colours = ColourWeights::kRecipe;
    /// Tags in which drawn colours are like the shape; nothing: all.
    std::optional<std::vector<std::string>> alike;
  } textures;

  struct Plane {
    Layout layout = Layout::kCircle;
    std::map<Eigen::Index, PlanePoint> anchors;  ///< by head; override the layout, all if kManual
  } plane;

  SamplingOptions sampling;

  /// What counts when two faces are compared.
  struct Distance {
    FaceArea area = FaceArea::kFront;
    std::optional<std::string> mask;  ///< image path, may hold <UDIM>; its first channel counts
  } distance;
  DiversityOptions diversity;
  BelievabilityOptions believability;
  std::vector<HandRecipe> recipes;
  std::vector<FamilyOptions> families;
  std::vector<Group> groups;

  struct Reviews {
    std::vector<std::filesystem::path> files;
    std::vector<std::string> texts;  ///< of each
    std::vector<Review> reviews;     ///< what stands in each
  } review;
  std::filesystem::path edits;  ///< what `crowdface edit` saved, merged already; empty: nothing

  /// What a face is compared with, point by point.
  struct Comparison {
    enum class With { kNothing, kTarget, kNearest, kFile } with = With::kNothing;
    std::filesystem::path file;  ///< a mesh, or the folder of a crowd whose faces have the same ids
    double scale_mm = 6;         ///< where the colour scale ends
  };
  struct ContactSheet {
    int columns = 6;
    int rows = 4;
    int cell = 256;  ///< pixels, one view
    std::vector<View> views = {View::kFront};
    std::vector<SheetLabel> labels = {SheetLabel::kId};
    SheetOrder order = SheetOrder::kPlan;
    Comparison compare;
    std::vector<SheetFormat> formats = {SheetFormat::kPng};  ///< png is always among them
    int shapes = 0;  ///< faces that are shown with each of their shapes, on pages of their own
    SheetTexture texture = SheetTexture::kAuto;

    /// A cell without a distance map, with two lines of text, as heads and families have them.
    CellSize plain_cell_size() const;
  };
  struct Output {
    std::filesystem::path directory;
    std::vector<MeshFormat> meshes = {MeshFormat::kObj};  ///< each once; may be empty
    std::vector<double> lods;  ///< levels of detail: percent of the triangles, descending
    Subdivision subdivision = Subdivision::kNone;  ///< what USD meshes say of themselves
    std::optional<ContactSheet> contact_sheet = ContactSheet{};  ///< none: `contact_sheet: none`
    Gallery gallery = Gallery::kAuto;
    /// Numbered subfolders of meshes, renders, … hold so many; none, 0: all in one folder.
    std::optional<std::uint64_t> faces_per_folder;
    std::map<std::string, SurfaceChoice> surfaces;  ///< by the material's name
  } output;

  /// Region names as they stand in a plan: `regions.names`, or "all".
  std::vector<std::string> region_names() const;
  /// Of what may be locked or inherited: the regions, or with bands "top/build", "top/skin", …
  std::vector<std::string> part_names() const;
  PlanNames plan_names() const;
};

/// The config as YAML with every default spelled out, keys in a fixed order: the same config gives
/// the same bytes. Read from a file in `directory`, it gives the same config again.
/// \param directory  where the text will be written; paths in it are relative to this folder.
std::string effective_config(const Config& config, const std::filesystem::path& directory);

/// The part of the effective config that a file of a face may depend on beside its recipe and what is read from
/// files: every key but those that are marked as `apart_from_faces`. A key at its default is left out, so that
/// faces made before the key existed count as done.
std::string face_settings(const Config& config);

}  // namespace crowdface
