// hb_bake_*: surfaces, clouds and volumes, stepped to the end or given up on the way. What comes out is taken by hb_irbf_create.
//
// behind: abi/bake.cpp core/irbf/bake.cpp core/irbf/body.cpp core/irbf/counted_mesh.cpp core/irbf/interior_voxels.cpp core/irbf/center_sampling.cpp core/irbf/bones.cpp core/irbf/sphere_packing.cpp core/irbf/sphere_tree.cpp
// behind: core/distance/fast_marching.cpp core/distance/filled_shell.cpp core/distance/heat_distance.cpp core/distance/interior_distance.cpp core/distance/interior_samples.cpp core/distance/mean_value_distance.cpp core/distance/merged_limbs.cpp core/distance/stencil.cpp core/distance/surface_crossings.cpp core/distance/voxel_domain.cpp
// behind: core/mesh/consistent_orientation.cpp core/mesh/enclosed_volume.cpp core/mesh/mean_value_coordinates.cpp core/mesh/sound_surface.cpp core/mesh/surface_geodesics.cpp core/mesh/triangle_sides.cpp core/mesh/triangle_tree.cpp core/mesh/weld.cpp
#include "meshes.hpp"
#include "target.hpp"

using namespace handlebody::fuzz;

namespace {

struct Given {
  hb_bake_options options{};
  std::vector<std::uint32_t> voxels;
  std::vector<double> density, bones;
  std::vector<std::uint8_t> used;
};

void choose(Bytes& bytes, const Mesh& mesh, Given& given) {
  hb_bake_options& options = given.options;
  options.center_count = bytes.option(1, bytes.byte() < 250 ? 4 : 50);
  options.resolution = bytes.option(8, bytes.byte() < 240 ? 9 : 24);
  options.method = bytes.option(0, 3);
  options.max_spheres = bytes.option(1, 8);
  options.packing = bytes.option(0, 2);
  options.quality = bytes.option(0, 2);
  if (bytes.byte() < 4) options.resolution = 0, options.quality = 0;  // the search takes longer than all else
  if (bytes.byte() < 30) options.max_spheres = 0;
  if (bytes.byte() < 30) options.center_count = 0;
  options.cloud = bytes.byte() < 30;
  options.straight_bones = bytes.byte() < 60;
  if (bytes.byte() < 30) options.tree_level = bytes.option(1, 10);
  if (bytes.byte() < 30) options.overlap = bytes.number();
  if (bytes.byte() < 30) options.smallest_radius = bytes.flip() ? bytes.positive() / 64 : bytes.number();
  if (bytes.byte() < 30) {
    options.bone_count = bytes.from_to(1, 3);
    for (std::uint32_t i = 0; i < 6 * options.bone_count; ++i) {
      const std::size_t corner = bytes.below(mesh.vertex_count());
      given.bones.push_back(bytes.wildly() ? bytes.number() : mesh.positions[3 * corner + i % 3] / 2);
    }
    options.bone_count = bytes.count(options.bone_count);
    options.bones = given.bones.data();
  }
  if (bytes.byte() < 30) {
    for (std::uint32_t& side : options.dims) side = bytes.count(bytes.from_to(1, 5));
    for (double& x : options.origin) x = bytes.number();
    options.spacing = bytes.positive();
    std::uint32_t voxel = bytes.below(4);
    for (std::uint32_t count = bytes.from_to(1, 20); count > 0; --count, voxel += 1 + bytes.below(3))
      given.voxels.push_back(bytes.wildly() ? bytes.index(voxel) : voxel);
    options.voxel_count = bytes.count(static_cast<std::uint32_t>(given.voxels.size()));
    options.voxels = given.voxels.data();
  }
  if (bytes.byte() < 30) {
    for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) given.density.push_back(bytes.positive() + 1e-6);
    options.density = given.density.data();
  }
  if (bytes.byte() < 30) {
    for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) given.used.push_back(bytes.byte() < 220);
    options.used = given.used.data();
  }
}

void read_warnings(hb_bake* bake, const Mesh& mesh) {
  hb_bake_warning warning{};
  const std::uint32_t count = hb_bake_get_warning(bake, 0xffffffff, &warning);
  require(warning.code == 0, "a warning that is not there is not written");
  for (std::uint32_t index = 0; index < count; ++index) {
    hb_bake_get_warning(bake, index, &warning);
    require(warning.vertex >= -1 && warning.vertex < static_cast<std::int64_t>(mesh.vertex_count()),
            "a warning's vertex is one of the mesh");
  }
}

void check(const hb_skeleton& skeleton, std::uint32_t spheres) {
  std::uint32_t steps = 0;
  for (std::uint32_t b = 0; b < skeleton.branch_count; ++b) {
    steps += skeleton.lengths[b];
    require(skeleton.lengths[b] > 0 && skeleton.parents[b] >= -1 && skeleton.parents[b] < static_cast<std::int64_t>(b),
            "a branch has nodes, and a parent before it");
  }
  require(steps == skeleton.step_count, "the steps are those of all branches");
  for (std::uint32_t i = 0; i < steps; ++i) require(skeleton.steps[i] < skeleton.node_count, "a step is at a node");
  require(skeleton.sphere_count == 0 || skeleton.sphere_count == spheres, "the branches are those of all spheres");
  for (std::uint32_t s = 0; s < skeleton.sphere_count; ++s)
    require(skeleton.sphere_branches[s] >= -1 && skeleton.sphere_branches[s] < static_cast<std::int64_t>(skeleton.branch_count),
            "a sphere's branch is there");
}

}  // namespace

FUZZ(bytes) {
  const Mesh mesh = make_mesh(bytes, 3, 3);
  Given given;
  choose(bytes, mesh, given);
  worked(hb_mesh_check_size(bytes.number() * 1e7, bytes.number() * 1e7));
  Owned<hb_bake_free> bake;
  const std::uint32_t vertices = bytes.count(mesh.vertex_count()),
                      triangles = bytes.count(given.options.cloud && bytes.flip() ? 0 : mesh.simplex_count());
  if (!bake.make([&](hb_bake** out) {
        return hb_bake_begin(mesh.positions.data(), vertices, mesh.simplices.data(), triangles, &given.options, out);
      }))
    return;
  // One in eight is given up after a few steps.
  unsigned left = bytes.byte() < 32 ? bytes.byte() % 32u : 100000;
  hb_body body{};
  double progress = 0;
  while (progress < 1 && left-- > 0) {
    const double before = progress;
    const std::int32_t status = hb_bake_step(bake.get(), &progress);
    if (!worked(status)) return read_warnings(bake.get(), mesh);
    require(progress >= before && progress <= 1, "progress grows from 0 to 1");
  }
  reached();
  read_warnings(bake.get(), mesh);
  hb_skeleton skeleton{};
  if (progress < 1) {
    require(hb_bake_body(bake.get(), &body) != HB_OK, "a bake that is not finished has no body");
    require(hb_bake_skeleton(bake.get(), &skeleton) != HB_OK, "a bake that is not finished has no skeleton");
    return;
  }
  require(hb_bake_body(bake.get(), &body) == HB_OK, "a finished bake has a body");
  require(body.vertex_count == mesh.vertex_count() && body.center_count > 0 && body.sphere_count > 0 && body.voxel_count > 0,
          "a body has all its parts");
  require(hb_bake_skeleton(bake.get(), &skeleton) == HB_OK, "a finished bake has a skeleton, or an empty one");
  check(skeleton, body.sphere_count);
  const hb_irbf_options options{0, 1e-6, 100, 1, 0.45, 1, 5, 0, 2, 0, bytes.below(2), 0, 0};
  Owned<hb_irbf_free> irbf;
  require(irbf.make([&](hb_irbf** out) { return hb_irbf_create(&body, &options, out); }), "IRBF takes every body that was baked");
}
