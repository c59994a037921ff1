// What callers count is met as what it is: unsigned numbers of 32 bits, whose products may need 64. Each function of the C
// interface that takes a count refuses one that no array has, and says so, before it reads or allocates; the 32-bit suite runs this
// where Index is signed and has 32 bits itself.
#include <doctest/doctest.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "abi/handlebody.h"

namespace {

/** Signed or multiplied, each is something else: -1, the lowest, the largest, and counts whose arrays have 2³² bytes and a few
 * more. */
constexpr std::array<std::uint32_t, 7> impossible{0xffffffff, 0x80000000, 0x80000003, 0x7fffffff,
                                                  0x40000001, 0x55555556, 0xaaaaaaab};

constexpr std::array<double, 24> numbers{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 0, 1, 0, 1, 0, 1, 1, 1, 1, 1};
constexpr std::array<std::uint32_t, 24> indices{0, 1, 2, 0, 1, 3, 0, 2, 3, 1, 2, 3};

/** `status` is a failure with words, and `out` is as it was. */
template <typename Object>
void check_refused(const char* what, std::uint32_t count, std::int32_t status, Object* out) {
  CAPTURE(what);
  CAPTURE(count);
  CHECK(status != HB_OK);
  CHECK(hb_last_error()->code == status);
  CHECK(std::string(hb_last_error()->message).size() > 10);
  CHECK(out == nullptr);
}

hb_rbf_options plain_rbf() {
  hb_rbf_options options{};
  options.width = options.support = 1;
  options.kernel = 3;
  options.degree = -1;
  options.order = 2;
  return options;
}

hb_simplex_mesh tetrahedron_surface() {
  return {numbers.data(), indices.data(), 4, 3, 4, 3};
}

}  // namespace

TEST_CASE("scattered data of impossible counts are refused") {
  const double *p = numbers.data(), *v = numbers.data();
  const hb_moving_least_squares_options moving{2, 0, 0, 1, 0};
  const hb_tension_spline_options tension{1, 0, 0, 0, 0};
  for (const std::uint32_t count : impossible) {
    hb_interpolant* out = nullptr;
    hb_rbf_options rbf = plain_rbf();
    check_refused("shepard", count, hb_shepard_create(p, v, count, 1, 1, 2, 0, &out), out);
    check_refused("shepard's outputs", count, hb_shepard_create(p, v, 4, 1, count, 2, 0, &out), out);
    check_refused("shepard's dimension", count, hb_shepard_create(p, v, 4, count, 1, 2, 0, &out), out);
    check_refused("moving", count, hb_moving_least_squares_create(p, v, count, 1, 1, &moving, nullptr, &out), out);
    check_refused("simplex", count, hb_simplex_linear_create(p, v, count, 2, 1, 0, &out), out);
    check_refused("natural", count, hb_natural_neighbor_create(p, v, count, 2, 1, 0, &out), out);
    check_refused("tension", count, hb_tension_spline_create(p, v, count, 1, 1, &tension, &out), out);
    check_refused("rbf", count, hb_rbf_create(p, v, count, 1, 1, &rbf, &out), out);
    check_refused("rbf's outputs", count, hb_rbf_create(p, v, 4, 1, count, &rbf, &out), out);
    rbf.center_count = count;
    rbf.centers = numbers.data();
    check_refused("centers", count, hb_rbf_create(p, v, 4, 1, 1, &rbf, &out), out);
    rbf.centers = nullptr;
    rbf.widths = numbers.data();
    check_refused("widths", count, hb_rbf_create(p, v, 4, 1, 1, &rbf, &out), out);
    CHECK(hb_rbf_check_size(count, 2, 0, 1) != HB_OK);
    CHECK(hb_rbf_check_size(4, 2, count, 1) != HB_OK);
  }
  hb_interpolant* out = nullptr;
  check_refused("2³² bytes and 8", 0x20000001, hb_shepard_create(p, v, 0x20000001, 1, 1, 2, 0, &out), out);
}

TEST_CASE("questions of impossible counts are refused") {
  const std::array<double, 4> points{0, 1, 2, 3}, values{0, 1, 0, 1};
  hb_interpolant* made = nullptr;
  const hb_rbf_options options = plain_rbf();
  REQUIRE(hb_rbf_create(points.data(), values.data(), 4, 1, 1, &options, &made) == HB_OK);
  std::array<double, 8> out{};
  for (const std::uint32_t count : impossible) {
    CHECK(hb_interpolant_evaluate(made, points.data(), count, out.data()) == HB_ERROR_INVALID_SHAPE);
    CHECK(hb_interpolant_gradient(made, points.data(), count, out.data()) == HB_ERROR_INVALID_SHAPE);
    CHECK(hb_interpolant_weights(made, points.data(), count, out.data()) == HB_ERROR_INVALID_SHAPE);
  }
  CHECK(hb_interpolant_weights(made, points.data(), 0x08000001, out.data()) == HB_ERROR_INVALID_SHAPE);  // times 4 points
  CHECK(out == std::array<double, 8>{});
  hb_interpolant_free(made);
}

TEST_CASE("meshes, clouds and volumes of impossible counts are refused") {
  for (const std::uint32_t count : impossible) {
    hb_bake* bake = nullptr;
    hb_bake_options options{};
    options.center_count = options.max_spheres = 4;
    options.resolution = 8;
    check_refused("vertices", count, hb_bake_begin(numbers.data(), count, indices.data(), 4, &options, &bake), bake);
    check_refused("triangles", count, hb_bake_begin(numbers.data(), 4, indices.data(), count, &options, &bake), bake);
    options.resolution = count;
    check_refused("resolution", count, hb_bake_begin(numbers.data(), 4, indices.data(), 4, &options, &bake), bake);
    options.resolution = 8, options.max_spheres = count;
    check_refused("spheres", count, hb_bake_begin(numbers.data(), 4, indices.data(), 4, &options, &bake), bake);
    options.max_spheres = 4, options.center_count = count;
    check_refused("centers", count, hb_bake_begin(numbers.data(), 4, indices.data(), 4, &options, &bake), bake);
    CHECK(hb_last_error()->code == HB_ERROR_INVALID_OPTION);
    options.center_count = 4, options.voxels = indices.data(), options.spacing = 1;
    options.dims[0] = options.dims[1] = options.dims[2] = 4;
    options.voxel_count = count;
    check_refused("voxels", count, hb_bake_begin(numbers.data(), 4, indices.data(), 4, &options, &bake), bake);
    options.voxel_count = 1;
    for (std::uint32_t& side : options.dims) {
      side = count;
      check_refused("dimensions", count, hb_bake_begin(numbers.data(), 4, indices.data(), 4, &options, &bake), bake);
      side = 4;
    }
    hb_tetrahedra* tetrahedra = nullptr;
    check_refused("tetrahedra", count, hb_tetrahedra_create(numbers.data(), count, indices.data(), 4, 8, &tetrahedra), tetrahedra);
    check_refused("faces", count, hb_tetrahedra_create(numbers.data(), 4, indices.data(), count, 8, &tetrahedra), tetrahedra);
    check_refused("cells", count, hb_tetrahedra_create(numbers.data(), 4, indices.data(), 4, count, &tetrahedra), tetrahedra);
    CHECK(hb_mesh_check_size(count, 1) == HB_ERROR_MESH_TOO_LARGE);
    CHECK(hb_mesh_check_size(1, count) == HB_ERROR_MESH_TOO_LARGE);
  }
}

TEST_CASE("a vertex of triangles counts, whatever the list of used vertices says") {
  const std::array<std::uint8_t, 4> none{};
  hb_bake_options options{};
  options.center_count = options.max_spheres = 4;
  options.resolution = 8;
  options.used = none.data();
  hb_bake* bake = nullptr;
  REQUIRE(hb_bake_begin(numbers.data(), 4, indices.data(), 4, &options, &bake) == HB_OK);
  for (double progress = 0; progress < 1;) REQUIRE(hb_bake_step(bake, &progress) == HB_OK);
  hb_bake_free(bake);
}

TEST_CASE("a baked body whose counts or numbers are impossible is refused") {
  hb_bake* bake = nullptr;
  hb_bake_options how{};
  how.center_count = how.max_spheres = 4;
  how.resolution = 8;
  REQUIRE(hb_bake_begin(numbers.data(), 4, indices.data(), 4, &how, &bake) == HB_OK);
  for (double progress = 0; progress < 1;) REQUIRE(hb_bake_step(bake, &progress) == HB_OK);
  hb_body whole;
  REQUIRE(hb_bake_body(bake, &whole) == HB_OK);
  const hb_irbf_options options{2, 1e-6, 100, -1, 0, 1, 5, 0, 2, 0, 1, 0, 0};
  hb_irbf* made = nullptr;
  for (const std::uint32_t count : impossible) {
    for (const auto member : {&hb_body::vertex_count, &hb_body::triangle_count, &hb_body::voxel_count, &hb_body::center_count,
                              &hb_body::sphere_count}) {
      hb_body body = whole;
      body.*member = count;
      check_refused("body", count, hb_irbf_create(&body, &options, &made), made);
    }
    for (int axis = 0; axis < 3; ++axis) {
      hb_body body = whole;
      body.dims[axis] = count;
      check_refused("grid", count, hb_irbf_create(&body, &options, &made), made);
    }
    if (count < whole.vertex_count) continue;
    for (const std::uint32_t at : {0u, whole.center_count - 1}) {
      std::vector<std::uint32_t> centers(whole.centers, whole.centers + whole.center_count);
      centers[at] = count;
      hb_body body = whole;
      body.centers = centers.data();
      check_refused("center", count, hb_irbf_create(&body, &options, &made), made);
    }
    std::vector<std::uint32_t> voxels(whole.voxels, whole.voxels + whole.voxel_count);
    voxels.back() = count;
    hb_body body = whole;
    body.voxels = voxels.data();
    check_refused("voxel", count, hb_irbf_create(&body, &options, &made), made);
  }
  // 65536 × 65536 codes would take 2³³ bytes, which 32 bits take for none.
  hb_body body = whole;
  body.center_count = body.voxel_count = 0x10000;
  check_refused("codes", 0x10000, hb_irbf_create(&body, &options, &made), made);

  REQUIRE(hb_irbf_create(&whole, &options, &made) == HB_OK);
  const std::array<double, 3> place{0, 0, 0};
  const std::uint32_t kind = 0;
  REQUIRE(hb_irbf_set_handles(made, place.data(), &kind, 1) == HB_OK);
  std::array<double, 3> out{7, 7, 7};
  hb_irbf_quality quality;
  for (const std::uint32_t count : impossible) {
    CHECK(hb_irbf_set_handles(made, place.data(), &kind, count) == HB_ERROR_INVALID_SHAPE);
    CHECK(hb_irbf_evaluate(made, place.data(), count, out.data()) == HB_ERROR_INVALID_SHAPE);
    CHECK(hb_irbf_measure(made, indices.data(), count, &quality) == HB_ERROR_INVALID_SHAPE);
    const std::array<std::uint32_t, 4> corners{0, 1, 2, count};
    CHECK(hb_irbf_measure(made, corners.data(), 1, &quality) == HB_ERROR_MESH_INDEX_OUT_OF_RANGE);
  }
  CHECK(out == std::array<double, 3>{7, 7, 7});
  hb_irbf_free(made);
  hb_bake_free(bake);
}

TEST_CASE("meshes that weights are for, handles and skins of impossible counts are refused") {
  const std::array<std::uint32_t, 2> vertices{0, 3}, owners{0, 1};
  hb_skinning_weights* weights = nullptr;
  const hb_simplex_mesh mesh = tetrahedron_surface();
  REQUIRE(hb_skinning_weights_create(&mesh, 1, 0, &weights) == HB_OK);
  std::array<double, 8> support{};
  hb_weight_measures measures;
  const auto refused = [](std::int32_t status) { CHECK(status != HB_OK); };
  for (const std::uint32_t count : impossible) {
    for (const auto member : {&hb_simplex_mesh::vertex_count, &hb_simplex_mesh::simplex_count, &hb_simplex_mesh::dimension,
                              &hb_simplex_mesh::corners}) {
      hb_simplex_mesh wrong = mesh;
      wrong.*member = count;
      hb_sound_mesh* sound = nullptr;
      hb_skinning_weights* made = nullptr;
      hb_skin* skin = nullptr;
      const hb_held_vertices held{vertices.data(), owners.data(), 2, 2};
      check_refused("sound mesh", count, hb_sound_mesh_create(&wrong, 1, 0, &sound), sound);
      check_refused("weights", count, hb_skinning_weights_create(&wrong, 1, 0, &made), made);
      refused(hb_measure_weights(&wrong, &held, numbers.data(), support.data(), &measures));
      if (member != &hb_simplex_mesh::dimension) wrong.dimension = 2;
      check_refused("minimizer", count, hb_minimizer_create(&wrong, &held, 0, &skin), skin);
    }
    for (const auto member : {&hb_held_vertices::count, &hb_held_vertices::handle_count}) {
      hb_held_vertices wrong{vertices.data(), owners.data(), 2, 2};
      wrong.*member = count;
      refused(hb_skinning_weights_set_handles(weights, &wrong));
      refused(hb_measure_weights(&mesh, &wrong, numbers.data(), support.data(), &measures));
      hb_simplex_mesh flat = mesh;
      flat.dimension = 2;
      hb_skin* skin = nullptr;
      check_refused("minimizer's handles", count, hb_minimizer_create(&flat, &wrong, 3, &skin), skin);
    }
    for (const bool of_owners : {false, true}) {
      const std::array<std::uint32_t, 2> number{0, count};
      const hb_held_vertices wrong{of_owners ? vertices.data() : number.data(), of_owners ? number.data() : owners.data(), 2, 2};
      refused(hb_skinning_weights_set_handles(weights, &wrong));
      refused(hb_measure_weights(&mesh, &wrong, numbers.data(), support.data(), &measures));
    }
    hb_skin* skin = nullptr;
    check_refused("blend", count, hb_linear_blend_create(numbers.data(), count, 3, numbers.data(), 2, 1, &skin), skin);
    check_refused("blend's handles", count, hb_linear_blend_create(numbers.data(), 4, 3, numbers.data(), count, 1, &skin), skin);
    check_refused("dual", count, hb_dual_quaternion_create(numbers.data(), count, 3, numbers.data(), 2, &skin), skin);
    check_refused("dual's handles", count, hb_dual_quaternion_create(numbers.data(), 4, 3, numbers.data(), count, &skin), skin);
  }
  hb_skinning_weights_free(weights);
}

TEST_CASE("grids of samples, pose spaces and searches of impossible counts are refused") {
  for (const std::uint32_t count : impossible) {
    hb_discrete_green* green = nullptr;
    check_refused("size", count, hb_discrete_green_create(count, 1, 1, indices.data(), numbers.data(), 2, &green), green);
    check_refused("order", count, hb_discrete_green_create(8, count, 1, indices.data(), numbers.data(), 2, &green), green);
    check_refused("samples", count, hb_discrete_green_create(8, 1, 1, indices.data(), numbers.data(), count, &green), green);
    const std::uint32_t place = count;
    check_refused("sample", count, hb_discrete_green_create(8, 1, 1, &place, numbers.data(), 1, &green), green);
    hb_pose_space* space = nullptr;
    check_refused("examples", count, hb_pose_space_create(numbers.data(), count, 1, 0, 3, 0, 0, &space), space);
    check_refused("axes", count, hb_pose_space_create(numbers.data(), 1, count, 0, 3, 0, 0, &space), space);
    hb_outlier_search search{};
    search.threshold = 4;
    const hb_rbf_options options = plain_rbf();
    CHECK(hb_find_outliers(numbers.data(), numbers.data(), count, 1, 1, &options, &search) != HB_OK);
    CHECK(hb_find_outliers(numbers.data(), numbers.data(), 4, count, 1, &options, &search) != HB_OK);
  }
}

TEST_CASE("`most` of a search may be any number: no more outliers are looked for than there are points") {
  const std::array<double, 6> points{0, 1, 2, 3, 4, 5}, values{0, 0, 9, 0, 0, 0};
  const hb_rbf_options options = plain_rbf();
  std::array<double, 6> scores{}, heights{}, other{};
  std::array<std::uint32_t, 6> outliers{};
  hb_outlier_search few{1, 0, 6, scores.data(), outliers.data(), heights.data(), 0, 0};
  REQUIRE(hb_find_outliers(points.data(), values.data(), 6, 1, 1, &options, &few) == HB_OK);
  REQUIRE(few.outlier_count > 0);
  hb_outlier_search many{1, 0, 0xffffffff, other.data(), outliers.data(), heights.data(), 0, 0};
  REQUIRE(hb_find_outliers(points.data(), values.data(), 6, 1, 1, &options, &many) == HB_OK);
  CHECK(many.outlier_count == few.outlier_count);
}

TEST_CASE("memory is refused without a trap, whatever is asked for") {
  for (const std::uint32_t bytes : {0u, 1u, 7u, 17u, 4096u}) {
    void* const memory = hb_alloc(bytes);
    if (bytes > 0) REQUIRE(memory != nullptr);
    CHECK(reinterpret_cast<std::uintptr_t>(memory) % 16 == 0);
    hb_release(memory);
  }
  if (sizeof(void*) > 4) return;
  for (const std::uint32_t bytes : {0xffffffffu, 0xfffffff0u, 0xffffff00u, 0xfffff000u, 0xff000000u})
    CHECK(hb_alloc(bytes) == nullptr);
}
