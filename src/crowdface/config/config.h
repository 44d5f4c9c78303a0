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
#include "crowdface/io/usd_subdivision.h"
#include "crowdface/parts/part_options.h"
#include "crowdface/plane/layout.h"
#include "crowdface/render/surface_kind.h"
#include "crowdface/render/view.h"
#include "crowdface/smooth/smoothing_operator.h"

namespace crowdface {

struct CellSize;  // render/contact_sheet.h

/// What to do if the heads are not aligned with each other.
enum class Align {
  kCheck,  ///< warn
  kRigid,  ///< align every head to the first by the best rotation and translation
  kNone,   ///< do not check
};

/// Whether a crowd gets a gallery page, on which users select faces.
enum class Gallery {
  kAuto,  ///< if there are pictures and this build contains the page
  kNone,
};

/// The weights with which a face's textures are blended: the weights of its shape (`kRecipe`), or
/// independently sampled weights (`kSampled`).
enum class ColourWeights { kRecipe, kSampled };

/// Which textures a face gets.
enum class TextureBlend {
  kAuto,    ///< a blend of the heads' textures, if these differ
  kTarget,  ///< the textures of its target
  kNone,    ///< pictures show no textures; written files are the same as with kTarget
};
/// A file format of blended textures.
enum class TextureFormat { kPng, kJpeg, kExr };
/// Whether rendered images show textures.
enum class SheetTexture {
  kAuto,  ///< if any head has textures
  kYes,
  kNo,
};

/// How the smoothed versions of each head are represented.
enum class Levels {
  kBasis,  ///< displacement fields fitted to each head, as many as `tolerance_mm` requires
  kExact,  ///< the smoothing filter computes every level
  kCubic,  ///< the paper's cubic polynomial in the level L per vertex (§5.1)
};

/// How rendered images show a material. Overrides the kind that the material's name suggests.
struct SurfaceChoice {
  SurfaceKind kind = SurfaceKind::kSkin;
  std::optional<std::array<std::uint8_t, 3>> colour;  ///< sRGB; none: the colour of `kind`
};

/// A line of text below a rendered image.
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
/// The order of the faces on contact sheets.
enum class SheetOrder { kPlan, kFamily, kGroup, kLikeness };
enum class SheetFormat { kPng, kExr, kPdf };

/// A config file after reading and checking, with every name resolved. Fields have the names of
/// their YAML keys; docs/config.md explains each. Paths are absolute or relative to the working
/// directory.
struct Config {
  std::filesystem::path file;  ///< path of the config file

  struct Crowd {
    std::string name;
    std::uint64_t count = 0;  ///< number of sampled faces; recipes add further faces
    std::uint64_t seed = 1;
    /// Not a key: the number of sampled faces in the folder, if it has a crowd of this config
    std::optional<std::uint64_t> existing_count;
  } crowd;

  struct Faces {
    std::vector<std::filesystem::path> files;    ///< #heads
    std::vector<std::string> names;              ///< #heads, from names_of_heads
    LengthUnit units = LengthUnit::kCentimetre;  ///< required in the file, never guessed
    Axis up = {1, 1};
    Axis front = {2, 1};
    Align align = Align::kCheck;
    std::vector<std::vector<std::string>> tags;  ///< #heads, the tags of each head
  } faces;

  struct Regions {
    std::vector<std::string> names;  ///< empty: the whole head is one region, "all"
    std::vector<std::string> mask;   ///< image paths, may contain <UDIM>; channels in this order
  } regions;

  struct Smoothing {
    double max_size_mm = 240;
    std::optional<std::uint64_t> max_iterations;  ///< overrides max_size_mm
    Boundary boundary = Boundary::kFixed;
    OperatorKind operator_kind = OperatorKind::kUmbrella;  ///< key `operator`
    Levels levels = Levels::kBasis;
    double tolerance_mm = 0.05;  ///< maximum error of `levels: basis` at any vertex and level
  } smoothing;

  struct Blending {
    Normalization normalization = Normalization::kPartition;
    Contacts contacts = Contacts::kAuto;  ///< treatment of lips and other nearly touching skin
  } blending;

  /// How eyes, teeth and lashes follow the skin. Parts are named by a material, a group or
  /// "component N".
  struct Parts {
    bool follow = true;  ///< false: `parts: none`, everything is blended as skin
    PartShape shape = PartShape::kTarget;
    std::vector<std::string> skin, rigid, bound;
    std::vector<std::vector<std::string>> together;  ///< each inner list forms one rigid part
  } parts;

  /// Expressions of a template or of each head, which are transferred to every face.
  struct Shapes {
    std::filesystem::path neutral;    ///< the template's neutral mesh; empty: no template
    std::filesystem::path directory;  ///< folder of the template's shapes
    std::filesystem::path heads;      ///< folder with a subfolder for each head; empty: none
    std::vector<std::string> names;   ///< empty: there are no shapes
    std::vector<std::filesystem::path>
        files;  ///< #names, the template's shapes; an empty path: the template lacks that shape
    std::vector<std::vector<std::filesystem::path>>
        of_head;  ///< #heads by #names; an empty path: the head lacks that shape
  } shapes;

  /// files from which tags and attachments were read
  std::vector<std::filesystem::path> lists;
  std::filesystem::path points;  ///< file of points that follow the face; empty: none
  /// file of landmarks that replace the landmarks found on the heads; empty: none
  std::filesystem::path landmarks;
  std::filesystem::path rig;  ///< GLB file of joints and the parts bound to them; empty: none

  /// The ring of vertices at the neck in which all faces end.
  struct Neck {
    std::filesystem::path body;          ///< the mesh that the faces end on; empty: none
    std::optional<Eigen::Index> like;    ///< the head whose neck all faces get
    bool mean = false;                   ///< all faces get the mean of the heads' necks
    std::filesystem::path rim;           ///< file of the ring's vertices; empty: the open rim
    std::filesystem::path body_rim;      ///< file of the body's vertices there; empty: an open rim
    double falloff_mm = 60;              ///< height above the ring up to which faces are bent
    std::filesystem::path body_texture;  ///< the body's colours, tinted for each face; empty: none
    bool show_body = false;              ///< whether pictures show the body
    bool write_body = false;             ///< whether GLB and USD files contain the body

    bool is_set() const { return !body.empty() || like || mean; }
    bool needs_body_mesh() const { return !body_texture.empty() || show_body || write_body; }
  } neck;

  /// An attachment that a head may wear, such as hair or glasses: a separate mesh.
  struct Attachment : AttachmentItem {
    std::filesystem::path file;
    AttachmentMove moves = AttachmentMove::kBend;
  };
  struct Attachments {
    /// All items were fitted to this head, or to the mesh `file`, which has the heads' topology.
    /// Without either, they were fitted to the mean of the heads.
    std::optional<Eigen::Index> head;
    std::filesystem::path file;
    std::vector<Attachment> items;
    std::map<std::string, double> none;  ///< by kind: share of faces without an item of that kind
    std::map<std::string, double>
        quotas;  ///< by kind, name or colour: share of the sampled faces that wear it
    std::map<std::string, double> hair_colours;  ///< by name: share of the faces with this colour
  } attachments;

  struct Textures {
    TextureBlend blend = TextureBlend::kAuto;
    std::optional<std::uint64_t>
        size;  ///< texels of the longer side; none: the size of the largest head texture
    std::vector<TextureFormat> formats = {TextureFormat::kPng};
    ColourWeights colours = ColourWeights::kRecipe;
    /// For ColourWeights::kSampled: textures come only from heads that agree with the face's target
    /// in each of these tags; none: in all tags.
    std::optional<std::vector<std::string>> alike;
  } textures;

  struct Plane {
    Layout layout = Layout::kCircle;
    std::map<Eigen::Index, PlanePoint>
        anchors;  ///< anchors by head, in place of the layout's; kManual needs all
  } plane;

  SamplingOptions sampling;

  /// Which vertices count in the distance between two faces.
  struct Distance {
    FaceArea area = FaceArea::kFront;
    std::optional<std::string> mask;  ///< image path, may contain <UDIM>; first channel = weight
  } distance;
  DiversityOptions diversity;
  BelievabilityOptions believability;
  std::vector<ManualRecipe> recipes;
  std::vector<FamilyOptions> families;
  std::vector<Group> groups;
  std::vector<FaceChange> changes;  ///< changes of single faces; reviews contain further ones

  /// A table of distributions of measurements.
  struct TraitTable {
    std::filesystem::path file;        ///< empty: none
    std::vector<TraitTarget> targets;  ///< the file's content, ascending by trait
  };
  TraitTable population;    ///< requested distributions of the sampled faces
  TraitTable quantiles_of;  ///< distributions for the percents in `traits`; empty: the heads

  struct Reviews {
    std::vector<std::filesystem::path> files;
    std::vector<std::string> texts;           ///< #files, the files' texts, with the key `count`
    std::vector<std::string> original_texts;  ///< #files, the files' texts as they were read
    std::vector<Review> reviews;              ///< #files, the parsed texts
    bool ignores_kept_reviews = false;        ///< the reviews in the crowd's folder are set aside
  } review;
  std::filesystem::path edits;  ///< file saved by `crowdface edit`, already merged; empty: none

  /// The mesh that each face is compared with, vertex by vertex, in a colour map.
  struct Comparison {
    enum class With { kNothing, kTarget, kNearest, kFile } with = With::kNothing;
    std::filesystem::path file;  ///< a mesh, or the folder of a crowd whose faces have the same ids
    double scale_mm = 6;         ///< distance at the end of the colour scale
  };
  struct ContactSheet {
    int columns = 6;
    int rows = 4;
    int cell = 256;  ///< width and height of one view in pixels
    std::vector<View> views = {View::kFront};
    std::vector<SheetLabel> labels = {SheetLabel::kId};
    SheetOrder order = SheetOrder::kPlan;
    Comparison compare;
    std::vector<SheetFormat> formats = {SheetFormat::kPng};  ///< always contains kPng
    int shapes = 0;  ///< number of faces whose shapes are shown, on separate pages
    SheetTexture texture = SheetTexture::kAuto;

    /// The size of a cell without a distance map and with two lines of text, as on the sheets of
    /// heads and families.
    CellSize plain_cell_size() const;
  };
  struct Output {
    std::filesystem::path directory;
    std::vector<MeshFormat> meshes = {MeshFormat::kObj};  ///< no duplicates; may be empty
    std::vector<double> lods;  ///< levels of detail: percent of the triangles, descending
    Subdivision subdivision = Subdivision::kNone;  ///< subdivision scheme that USD files declare
    /// empty for `contact_sheet: none`
    std::optional<ContactSheet> contact_sheet = ContactSheet{};
    Gallery gallery = Gallery::kAuto;
    /// Number of faces in each numbered subfolder of meshes, renders, …; none or 0: no subfolders.
    std::optional<std::uint64_t> faces_per_folder;
    std::map<std::string, SurfaceChoice> surfaces;  ///< settings by material name
  } output;

  /// Returns `regions.names`, or {"all"} if there are no regions. Plans use these names.
  std::vector<std::string> region_names() const;
  /// Returns the names of the parts that can be locked or inherited: the regions, or with bands
  /// "top/build", "top/skin", …
  std::vector<std::string> part_names() const;
  PlanNames plan_names() const;
  /// Returns the measurements that the config names, ascending, as indices into measurements().
  std::vector<std::size_t> named_traits() const;
};

/// Returns the config as YAML with every default written out and keys in a fixed order. The same
/// config gives the same bytes. A file in `directory` with this text reads back as the same config.
/// \param directory  the folder that the written paths are relative to.
std::string effective_config(const Config& config, const std::filesystem::path& directory);

/// Returns the part of the effective config that a face's files may depend on, apart from its
/// recipe and the input files: every key that is not marked with Key::ignored_by_face_files. Keys
/// at their default are left out, so that faces written before a key existed stay up to date.
std::string face_settings(const Config& config);

/// Returns the part of the effective config that a plan depends on, apart from reviews: every key
/// that is not marked with Key::ignored_by_recipes, and `changes`.
/// \param directory  the folder that the paths are relative to.
std::string plan_settings(const Config& config, const std::filesystem::path& directory);

}  // namespace crowdface
