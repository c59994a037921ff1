// Skins: linear blending, dual quaternions, and energies that are minimized.
//
// behind: abi/skin.cpp core/skinning/skin.cpp core/skinning/linear_blend.cpp core/skinning/dual_quaternion.cpp core/skinning/as_rigid_as_possible.cpp core/skinning/held_deformation.cpp core/skinning/quadratic_deformation.cpp core/numerics/min_quad_with_fixed.cpp core/mesh/cotangent_laplacian.cpp
#include "meshes.hpp"
#include "target.hpp"

using namespace handlebody::fuzz;

FUZZ(bytes) {
  const std::uint32_t kind = bytes.below(3), dimension = kind == 2 ? 2 : bytes.from_to(2, 3);
  Owned<hb_skin_free> skin;
  std::vector<float> moved;
  std::uint32_t handles = 0;
  if (kind == 2) {
    const Mesh mesh = make_mesh(bytes, 2, 3);
    const Held held = hold(bytes, mesh.vertex_count());
    const hb_simplex_mesh view = mesh.view(bytes);
    const hb_held_vertices holding = held.view(bytes);
    const std::uint32_t energy = bytes.option(0, 3);
    if (!skin.make([&](hb_skin** out) { return hb_minimizer_create(&view, &holding, energy, out); })) return;
    moved.assign(mesh.positions.size() + 1, 7);
    handles = held.handle_count;
  } else {
    handles = bytes.from_to(1, 6);
    const std::uint32_t vertices = bytes.from_to(1, 40);
    const std::vector<double> positions = bytes.numbers(vertices * 3);
    std::vector<double> weights = bytes.numbers(vertices * handles);
    for (double& weight : weights) weight = bytes.byte() < 60 ? 0 : std::abs(weight);
    const std::uint32_t count = bytes.count(vertices), handle_count = bytes.count(handles), form = bytes.option(0, 1);
    const std::uint32_t d = bytes.count(dimension);
    if (!skin.make([&](hb_skin** out) {
          return kind == 0 ? hb_linear_blend_create(positions.data(), count, d, weights.data(), handle_count, form, out)
                           : hb_dual_quaternion_create(positions.data(), count, d, weights.data(), handle_count, out);
        }))
      return;
    moved.assign(positions.size() + 1, 7);
  }
  reached();
  for (int frame = 0; frame < 3; ++frame) {
    double* const transforms = hb_skin_transforms(skin.get());
    for (std::uint32_t i = 0; i < handles * dimension * (dimension + 1); ++i)
      if (bytes.byte() < 80) transforms[i] = bytes.number();
    worked(hb_skin_deform(skin.get(), moved.data()));
    hb_minimizer_report report{};
    require(worked(hb_minimizer_deform(skin.get(), bytes.option(0, 4) % 64, moved.data(), &report)) ? kind == 2 : true,
            "only a skin that minimizes an energy reports one");
  }
  require(moved.back() == 7, "nothing is written beyond the positions");
}
