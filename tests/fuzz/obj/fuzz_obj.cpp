// OBJ files, byte by byte.
#include "fuzz/fuzz_mesh.hpp"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  scree::fuzz::read_as_mesh(data, size, ".obj");
  return 0;
}

void scree::fuzz::write_seeds(const std::filesystem::path& folder) {
  std::ofstream{folder / "tetrahedron.obj"}
      << "o tetra\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\n"
         "f 2 3 4\n";
  std::ofstream{folder / "square.obj"}
      << "mtllib x.mtl\nv 0 0 0 1\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvn 0 0 1\n"
         "usemtl a\ns 1\ng one\nf 1/1/1 2/1/1 3/1/1 4/1/1\nf -4//1 -3//1 -2//1\nl 1 2\n"
         "p 1\n";
}
