# Installs the library, its headers, the plugins and a package with which plugins outside the tree build.
include(CMakePackageConfigHelpers)
