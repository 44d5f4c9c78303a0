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
#include "crowdface/cast/compared_area.h"
#include "crowdface/cast/plan_names.h"
#include "crowdface/core/indirect.h"
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

// The headers of cast/ define the sections about casting. Only code that uses one of these sections
// includes the section's header, so that a new field recompiles only this code.
struct BelievabilityOptions;
struct DiversityOptions;
struct FaceChange;
struct FamilyOptions;
struct Group;
struct ManualRecipe;
struct Review;
struct SamplingOptions;
struct TraitTarget;

/// What to do if the heads are not aligned with each other.
enum class Align {
  kCheck,  ///< crowdface warns about heads that are not aligned, and does not move them
  /// crowdface aligns every head rigidly with the first head, by the best rotation and translation
  kRigid,
  kNone,  ///< crowdface neither checks whether the heads are aligned nor moves them
};

/// Whether a crowd gets a gallery page, on which users select faces.
enum class Gallery {
  kAuto,  ///< the crowd gets a gallery if it has pictures and this build contains the gallery page
  kNone,  ///< the crowd gets no gallery
};

/// The weights with which the heads' textures are blended into a face's textures: the weights that
/// blend the face's shape (`kRecipe`), or independently sampled weights (`kSampled`).
enum class ColourWeights { kRecipe, kSampled };

/// Which textures a new face gets.
enum class TextureBlend {
  /// the face gets a blend of the heads' textures; like kTarget if these textures do not differ
  kAuto,
  kTarget,  ///< the face gets the textures of its target
  /// the face's files get the textures of its target, but rendered images show no textures
  kNone,
};
/// A file format of blended textures.
enum class TextureFormat { kPng, kJpeg, kExr };
/// Whether contact sheets and other rendered images show textures.
enum class SheetTexture {
  kAuto,  ///< images show textures if at least one head has textures
  kYes,   ///< images show textures; it is an error if no head has textures
  kNo,    ///< images show no textures
};

/// How the smoothed versions of each head are represented.
enum class LevelRepresentation {
  /// by displacement fields that are fitted to each head; `tolerance_mm` determines the number of
  /// fields
  kBasis,
  kExact,  ///< nothing is stored; the smoothing filter computes each level on demand
  kCubic,  ///< by a cubic polynomial of the smoothing level L for each vertex (§5.1 of the paper)
};

/// How rendered images show a material. This overrides the kind of surface that the material's name
/// suggests.
struct MaterialAppearance {
  SurfaceKind kind = SurfaceKind::kSkin;
  std::optional<std::array<std::uint8_t, 3>> colour;  ///< sRGB; none: the default colour of `kind`
};

/// What a line of text below a rendered image of a face shows. kNearest is the nearest face of the
/// crowd, kNearestHead is the nearest head, and kTags are the tags of the face's target.
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
/// The order of the faces on contact sheets. With kLikeness, similar faces are side by side.
enum class SheetOrder { kPlan, kFamily, kGroup, kLikeness };
/// A file format of contact sheets.
enum class SheetFormat { kPng, kExr, kPdf };

/// A config file after reading and checking. Names of heads, regions and bands are replaced by
/// indices. Most members have the names of the YAML keys, which docs/config.md explains. Paths are
/// absolute or relative to the working directory.
struct Config {
  Config();
  Config(const Config&);
  Config(Config&&) noexcept;
  Config& operator=(const Config&);
  Config& operator=(Config&&) noexcept;
  ~Config();

  std::filesystem::path file;  ///< path of the config file

  struct Crowd {
    std::string name;
    std::uint64_t count = 0;  ///< number of sampled faces; recipes and families add further faces
    std::uint64_t seed = 1;
    /// The number of sampled faces that the output folder already contains. Empty if the folder
    /// contains no crowd, or a crowd of another config. (This is not a config key.)
    std::optional<std::uint64_t> existing_face_count;
  } crowd;

  struct Faces {
    std::vector<std::filesystem::path> files;  ///< one file for each head
    std::vector<std::string> names;            ///< name of each head, made from its file's path
    /// unit of the heads' positions; required in the config, never guessed
    LengthUnit units = LengthUnit::kCentimetre;
    Axis up = {1, 1};     ///< direction from chin to crown; the default is +y
    Axis front = {2, 1};  ///< direction in which the faces look; the default is +z
    Align align = Align::kCheck;
    std::vector<std::vector<std::string>> tags;     ///< for each head, its tags
    std::vector<std::optional<double>> ages_years;  ///< for each head, its age, if it is known
  } faces;

  struct Regions {
    /// names of the regions; empty: the whole head is one region, "all"
    std::vector<std::string> names;
    /// paths of mask files: images (a path may contain <UDIM>) or tables of vertex weights;
    /// region_weights assigns the channels of these files to the regions
    std::vector<std::string> mask;
  } regions;

  struct Smoothing {
    double max_size_mm = 240;  ///< largest size (wavelength) of detail that smoothing can remove
    /// largest number of smoothing iterations; if set, max_size_mm has no effect
    std::optional<std::uint64_t> max_iterations;
    Boundary boundary = Boundary::kFixed;  ///< whether smoothing moves open mesh boundaries
    /// how one iteration smooths (key `operator`)
    OperatorKind operator_kind = OperatorKind::kUmbrella;
    /// how the smoothed versions of the heads, one for each smoothing level, are represented
    LevelRepresentation levels = LevelRepresentation::kBasis;
    /// with `levels: basis`: largest distance between a vertex of a smoothed head and the vertex's
    /// approximation by displacement fields
    double tolerance_mm = 0.05;
  } smoothing;

  struct Blending {
    /// how the weights of target and sources are normalised (Eq. 3)
    Normalization normalization = Normalization::kPartition;
    /// how lips and other nearly touching parts of the skin are treated
    ContactHandling contacts = ContactHandling::kAuto;
  } blending;

  /// How eyes, teeth and lashes follow the skin. The config names such a part by its material, its
  /// group, or as "component N".
  struct Parts {
    /// whether eyes, teeth and lashes follow the skin. False if the config has `parts: none`: then
    /// all components of a head are blended like skin
    bool follow_skin = true;
    /// whether the shape of a rigid part is the target's or blended
    PartShape shape = PartShape::kTarget;
    /// Names of the components that are blended (skin), move rigidly (rigid), or have vertices that
    /// follow the skin (bound). crowdface classifies all other components.
    std::vector<std::string> skin, rigid, bound;
    /// Groups of parts. The parts of each group move together as one rigid part.
    std::vector<std::vector<std::string>> together;
  } parts;

  /// Expressions (blend shapes) of a template or of each head. They are transferred to every face.
  struct Shapes {
    std::filesystem::path neutral;    ///< the template's neutral mesh; empty: no template
    std::filesystem::path directory;  ///< folder of the template's shapes
    /// folder that contains a subfolder with shapes for each head; empty: none
    std::filesystem::path heads_directory;
    std::vector<std::string> names;  ///< names of the shapes; empty: there are no shapes
    /// for each shape in `names`: the file of the template's version of the shape; empty if the
    /// template lacks the shape
    std::vector<std::filesystem::path> template_files;
    /// for each head, one file for each shape in `names`: the file of the head's own version of the
    /// shape; empty if the head lacks the shape
    std::vector<std::vector<std::filesystem::path>> head_files;
  } shapes;

  /// files from which tags and attachments have been read
  std::vector<std::filesystem::path> tag_and_attachment_files;
  /// file of points (positions on the heads) that follow each face; empty: none
  std::filesystem::path points;
  /// file of landmarks, which are used instead of landmarks found on the heads; empty: none
  std::filesystem::path landmarks;
  /// GLB file with joints and with the parts bound to these joints; empty: none
  std::filesystem::path rig;

  /// The neck ring: the ring of vertices at the neck where the meshes of all faces end.
  struct Neck {
    std::filesystem::path body;  ///< mesh of the body to which the faces are attached; empty: none
    std::optional<Eigen::Index> neck_head;  ///< head whose neck all faces get (key `like`)
    bool uses_mean_neck = false;            ///< whether all faces get the mean of the heads' necks
    /// file that lists the vertices of the neck ring on the heads; empty: the neck ring is the open
    /// border of the heads' meshes
    std::filesystem::path rim;
    /// file that lists the vertices of the neck ring on the body; empty: the neck ring is an open
    /// border of the body's mesh
    std::filesystem::path body_rim;
    /// Each face is bent near the neck ring, so that the face fits the ring. The bend fades out
    /// over this distance from the ring, measured along the skin.
    double falloff_mm = 60;
    /// the body's colour texture, which is tinted for each face; empty: none
    std::filesystem::path body_texture;
    bool show_body = false;   ///< whether pictures show the body
    bool write_body = false;  ///< whether GLB and USD files contain the body

    /// Returns whether all faces get the same neck ring.
    bool is_set() const { return !body.empty() || neck_head || uses_mean_neck; }
    bool needs_body_mesh() const { return !body_texture.empty() || show_body || write_body; }
  } neck;

  /// An attachment that a face may wear, such as hair or glasses. Each attachment is a separate
  /// mesh.
  struct Attachment : AttachmentItem {
    std::filesystem::path file;                    ///< OBJ file of the attachment's mesh
    AttachmentMove moves = AttachmentMove::kBend;  ///< how the attachment follows the skin
  };
  struct Attachments {
    /// The head to which all items were fitted, if the key `fitted_to` names a head. Otherwise, the
    /// items were fitted to the mesh `file` (with the heads' topology) or, if `file` is empty, to
    /// the mean of the heads.
    std::optional<Eigen::Index> fitted_head;
    /// mesh to which all items were fitted, see `fitted_head`; empty: none
    std::filesystem::path file;
    std::vector<Attachment> items;
    /// by kind: fraction of the faces that wear no item of the kind (key `none`)
    std::map<std::string, double> fraction_without_item_by_kind;
    /// by kind, name or colour of items: fraction of the sampled faces that wear such an item
    std::map<std::string, double> quotas;
    /// by name of a hair colour: fraction of the faces that have this colour
    std::map<std::string, double> hair_colours;
  } attachments;

  struct Textures {
    TextureBlend blend = TextureBlend::kAuto;  ///< which textures a new face gets
    /// number of texels of a texture's longer side; none: the size of the largest texture of
    /// any head
    std::optional<std::uint64_t> size;
    std::vector<TextureFormat> formats = {TextureFormat::kPng};
    ColourWeights colours = ColourWeights::kRecipe;
    /// Key `alike`, used for ColourWeights::kSampled. A head may lend textures to a face only if
    /// the head and the face's typical head (see typical_head) agree in each of these tags: both
    /// heads have the tag, or neither head has the tag. nullopt: the two heads must agree in all
    /// tags.
    std::optional<std::vector<std::string>> matching_tags;
  } textures;

  struct Plane {
    Layout layout = Layout::kCircle;  ///< how the heads' anchors are placed on the weight plane
    /// anchors by head, which replace the anchors of the layout; with kManual, every head needs an
    /// anchor
    std::map<Eigen::Index, PlanePoint> anchors;
  } plane;

  Indirect<SamplingOptions> sampling;

  /// Which vertices count when the distance between two faces is measured.
  struct Distance {
    ComparedArea area = ComparedArea::kFront;  ///< part of the skin that distances compare
    /// path of a mask file: an image (the path may contain <UDIM>) or a table of vertex weights;
    /// the first channel gives the weight of each vertex
    std::optional<std::string> mask;
  } distance;
  Indirect<DiversityOptions> diversity;
  Indirect<BelievabilityOptions> believability;
  std::vector<ManualRecipe> recipes;
  std::vector<FamilyOptions> families;
  std::vector<Group> groups;
  /// changes of single faces; reviews may request further changes
  std::vector<FaceChange> changes;

  /// A table of distributions of measurements, read from a file.
  struct TraitTable {
    std::filesystem::path file;        ///< path of the table's file; empty: no table
    std::vector<TraitTarget> targets;  ///< the table's distributions, sorted by measurement
  };
  TraitTable population;  ///< distributions that the measurements of the sampled faces should have
  /// The table of the key `quantiles_of`. A limit of n % in `traits` is the n % quantile of the
  /// table's distribution or, for measurements that the table lacks, of the heads' values.
  TraitTable quantile_table;

  struct Reviews {
    std::vector<std::filesystem::path> files;  ///< the review files
    /// for each review file: its text; the keys `count` and `min_distance` are added if they are
    /// missing and their values are known
    std::vector<std::string> texts;
    std::vector<std::string> original_texts;  ///< for each review file: its unchanged text
    std::vector<Review> reviews;              ///< for each review file: the review in it
    /// whether the reviews stored in the crowd's folder are ignored
    bool ignores_stored_reviews = false;
  } review;
  /// file that `crowdface edit` has saved; its content is already merged into this config; empty:
  /// none
  std::filesystem::path edits;

  /// The mesh with which each face is compared, vertex by vertex: the face's target (kTarget), the
  /// nearest face of the crowd (kNearest), or `file`. A colour map shows the distances.
  struct MeshComparison {
    /// What each face is compared with: nothing (kNothing: no comparison), the face's target
    /// (kTarget), the nearest face of the crowd (kNearest), or `file` (kFile).
    enum class Reference { kNothing, kTarget, kNearest, kFile } reference = Reference::kNothing;
    /// a mesh, or the folder of another crowd whose faces have the same ids
    std::filesystem::path file;
    double scale_mm = 6;  ///< distance that the last colour of the colour scale represents
  };
  struct ContactSheet {
    /// number of faces per row and per column of a page of the contact sheet
    int columns = 6, rows = 4;
    int cell = 256;  ///< width and height of one view in pixels
    std::vector<View> views = {View::kFront};
    std::vector<SheetLabel> labels = {SheetLabel::kId};
    SheetOrder order = SheetOrder::kPlan;
    MeshComparison compare;  ///< the sheet shows the distance of each face from this mesh
    /// formats of the contact sheet; always contains kPng
    std::vector<SheetFormat> formats = {SheetFormat::kPng};
    /// number of faces whose expressions (blend shapes) are shown on separate pages
    int face_count_on_shape_pages = 0;
    SheetTexture texture = SheetTexture::kAuto;

    /// Returns the size of a cell without a distance map and with two lines of text. Sheets of
    /// heads and families have such cells.
    CellSize plain_cell_size() const;
  };
  struct Output {
    std::filesystem::path directory;  ///< the crowd's folder
    /// mesh formats to write, without duplicates; may be empty
    std::vector<MeshFormat> meshes = {MeshFormat::kObj};
    /// for each level of detail: percentage of the mesh's triangles that the level keeps;
    /// descending
    std::vector<double> lods;
    /// subdivision scheme that is declared in USD files
    Subdivision subdivision = Subdivision::kNone;
    /// empty if the config has `contact_sheet: none`
    std::optional<ContactSheet> contact_sheet = ContactSheet{};
    Gallery gallery = Gallery::kAuto;
    /// Number of faces in each numbered subfolder of the folders meshes, renders, …. None or 0:
    /// there are no subfolders.
    std::optional<std::uint64_t> faces_per_folder;
    /// by name of a material: how rendered images show the material
    std::map<std::string, MaterialAppearance> surfaces;
  } output;

  /// Returns `regions.names`, or {"all"} if the config has no regions. Plans use these names.
  std::vector<std::string> region_names() const;
  /// Returns the names of all pairs of a region and a band, such as "top/build"; without bands, the
  /// names of the regions. Users can lock each pair, and a child can inherit each pair from a
  /// parent.
  std::vector<std::string> region_band_names() const;
  /// Returns the names by which the plan refers to heads, regions, bands, attachments and traits.
  PlanNames plan_names() const;
  /// Returns the measurements that the config mentions, as ascending indices into measurements().
  std::vector<std::size_t> named_traits() const;
};

/// Returns the config as YAML with every default written out and keys in a fixed order. The same
/// config always gives the same bytes. If the text is stored in a file in `directory`, reading this
/// file gives the same config.
///
/// \param directory  the folder to which written paths are relative.
std::string effective_config(const Config& config, const std::filesystem::path& directory);

/// Returns the keys of the effective config that affect the files of faces: all keys except the
/// keys marked with Key::not_affecting_face_files. The files of a face depend only on these keys,
/// the face's recipe and the input files. Keys with their default value are omitted, so that
/// existing faces stay up to date if a new version of the program adds a key.
std::string face_settings_yaml(const Config& config);

/// Returns the keys of the effective config that affect recipes: all keys except the keys marked
/// with Key::not_affecting_recipes. Also returns the key `changes`. Apart from reviews, a plan
/// depends only on the returned keys.
///
/// \param directory  the folder to which the paths are relative.
std::string plan_settings_yaml(const Config& config, const std::filesystem::path& directory);

}  // namespace crowdface
