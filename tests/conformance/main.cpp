// scree-conformance PLUGIN.so [GoogleTest's options]: whether a plugin keeps what its interfaces promise.
// Exit codes: 0 all checks hold; 1 some do not; 2 the library is refused, or none was named.
#include <gtest/gtest.h>

#include <cstdio>

#include "conformance/subject.hpp"

int main(int argc, char** argv) {
  if (argc < 2 || argv[1][0] == '-') {
    std::fputs("usage: scree-conformance PLUGIN.so [--gtest_filter=... and other options of GoogleTest]\n", stderr);
    return 2;
  }
  try {
    scree::test::load_subjects(argv[1]);
  } catch (const scree::Error& problem) {
    std::fprintf(stderr, "%s\n", problem.what());
    return 2;
  }
  if (scree::test::subjects().empty()) {
    std::fprintf(stderr, "%s lists no plugin; add one in the function that scree_plugin_library names\n", argv[1]);
    return 2;
  }
  testing::InitGoogleTest(&argc, argv);  // asks for the cases, so the library comes first
  return RUN_ALL_TESTS();
}
