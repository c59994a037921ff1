// Deformations of a triangle mesh in the plane that minimize an energy while handles hold some of its vertices: what they have in
// common.
//
// A handle holds its vertices at T [v; 1]. So that a transform's rotation counts for a handle of one vertex too, it also holds the
// vertices around that one, except those that another handle holds and those that are around two such handles. Connected parts
// without a handle move as a whole with the nearest one (see held_vertices.hpp).
//
// All energies are of displacements u − v, in double precision: with identities nothing moves at all.
#pragma once

#include "core/numerics/min_quad_with_fixed.hpp"
#include "core/skinning/held_vertices.hpp"
#include "core/skinning/skin.hpp"

namespace handlebody {

/** Twice the signed area of a triangle: at the positions p (n×2), or moved by u (n×2). */
double doubled_area(const std::uint32_t* corners, const double* p, const double* u = nullptr);

/** The result of the last deform(). */
struct DeformationReport {
  double energy = 0;
  std::uint32_t iterations = 0, flips = 0;  // triangles whose orientation changed, or whose area vanished
};

class HeldDeformation : public Skin {
 public:
  const DeformationReport& report() const { return report_; }

  /** The most rounds in a frame, for energies that are minimized iteratively. */
  void set_iterations(std::uint32_t most) { most_iterations_ = most; }

 protected:
  struct Setup {
    SimplexMesh mesh;
    Indices owner_of;  // the handle that holds a vertex, or `no_index`
    Index handles;
  };

  /** Checks mesh and handles, and decides who holds what. MESH_*, INVALID_SHAPE where the mesh is not of triangles in the plane,
   * HANDLES_MISSING, HANDLE_OUT_OF_RANGE or HANDLE_CONFLICT. */
  static Result<Setup> set_up(SimplexMesh mesh, HeldVertices held);

  /** Factors an energy's matrix, of the n vertices or of their 2n coordinates, for the vertices that nothing holds. OUT_OF_MEMORY,
   * or SYSTEM_SINGULAR where it does not determine them. */
  static Result<std::unique_ptr<MinQuadWithFixed>> free_solver(const SparseMatrix& q, const Indices& owner_of);

  explicit HeldDeformation(Setup setup);

  /** Computes the free rows of `displacements_` from the held ones. */
  virtual void minimize() = 0;

  SimplexMesh mesh_;
  Indices owner_of_;
  Matrix displacements_;  // n×2
  DeformationReport report_;
  std::uint32_t most_iterations_ = 1;

 private:
  void move(float* out) final;
};

}  // namespace handlebody
