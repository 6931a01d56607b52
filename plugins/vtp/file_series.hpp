// FileSeries: files of one thing at several times, and the collection (.pvd) that ParaView opens.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace scree {

class StateReader;
class StateWriter;

/// "SERIES_00000120.vtp" for step 120.
[[nodiscard]] std::string numbered_file(const std::string& series, std::uint64_t step);

/// The frames of a collection. A run that goes on keeps them.
class FileSeries {
 public:
  /// One line of a collection.
  struct Frame {
    double time;  ///< [s]
    int part;     ///< parts of one time are shown together
    std::string file;
  };

  void add(double time, int part, const std::string& file) { frames_.push_back({time, part, file}); }
  [[nodiscard]] const std::vector<Frame>& frames() const { return frames_; }
  /// Writes the collection as a whole or not at all. @throws Error (io).
  void write(const std::filesystem::path& collection) const;

  void save(StateWriter& out, const std::string& name) const;
  /// Frames whose files do not exist in `results` are left out: a run may go on in a new folder.
  void load(const StateReader& in, const std::string& name, const std::filesystem::path& results);

 private:
  std::vector<Frame> frames_;
};

}  // namespace scree
