// Files that are read and written under several names.
#include "mpm/math/files_in_use.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "checkpoint_run.hpp"
#include "mpm/math/output_file.hpp"

namespace mpm::test {
namespace files_in_use_test {

namespace fs = std::filesystem;

TEST(FilesInUse, OneFileUnderTwoNames) {
  const Folder folder;
  std::ofstream(folder.file("a")) << "text";
  fs::create_symlink("a", folder.file("link"));
  fs::create_symlink("none", folder.file("dangling"));
  fs::create_symlink("round", folder.file("round"));
  fs::create_hard_link(folder.file("a"), folder.file("hard"));
  EXPECT_EQ(behind_links(folder.file("link")), behind_links(folder.file("a")));
  EXPECT_EQ(behind_links(folder.file("dangling")), behind_links(folder.file("./none")));
  EXPECT_FALSE(behind_links(folder.file("round")).empty());
  FilesInUse files;
  files.reads("the scene", folder.file("a"));
  files.reads("nothing", "");
  for (const char* name : {"a", "./a", "link", "hard"}) EXPECT_THROW(files.writes("--x", folder.file(name)), FileInUse);
  files.writes("--x", folder.file("none"));
  files.writes("--x", folder.file("none"));  // one option may name a file twice
  EXPECT_THROW(files.writes("--y", folder.file("dangling")), FileInUse);
  EXPECT_NO_THROW(files.writes("--y", folder.file("b")));
}

TEST(FilesInUse, FilesOfAFolder) {
  const Folder folder, other;
  std::ofstream(folder.file("run.csv")) << "text";
  fs::create_directory_symlink(folder.file("."), other.file("there"));
  fs::create_symlink(folder.file("run.csv"), other.file("table.csv"));
  FilesInUse files;
  files.reads("the map", folder.file("run.csv"));
  EXPECT_NO_THROW(files.writes_into("--x", folder.file("."), "[a-q].*\\.csv"));
  EXPECT_THROW(files.writes_into("--x", folder.file("."), "run\\.csv"), FileInUse);
  EXPECT_THROW(files.writes_into("--x", other.file("there"), "run\\.csv"), FileInUse);
  EXPECT_THROW(files.writes_into("--x", other.file("."), "table\\.csv"), FileInUse);  // a link in the folder
  EXPECT_THROW(files.writes("--y", folder.file("abc.csv")), FileInUse);
  EXPECT_NO_THROW(files.writes("--y", folder.file("abc.json")));
}

}  // namespace files_in_use_test
}  // namespace mpm::test
