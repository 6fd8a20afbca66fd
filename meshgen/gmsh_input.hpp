// The file that Gmsh opens for a user's model.
#pragma once

#include <filesystem>

#include "meshgen/deck.hpp"
#include "support/temporary_folder.hpp"

namespace airybench {

// The model's own file, or one in a temporary folder: what a *.gz holds, an Abaqus file as MSH,
// text without what Gmsh stumbles over, a .geo whose last line does not end included by another.
// While it lives. What Gmsh would read wrongly without a word, as half an .stl, is refused.
class GmshInput {
 public:
  // Throws InputError, without the file's name.
  explicit GmshInput(const std::filesystem::path& model);
  const std::filesystem::path& file() const { return file_; }

 private:
  TemporaryFolder folder_;
  std::filesystem::path file_;
};

// An .inp, or what an .inp.gz holds. Throws InputError, without the file's name.
Deck read_deck_of(const std::filesystem::path& model);

}  // namespace airybench
