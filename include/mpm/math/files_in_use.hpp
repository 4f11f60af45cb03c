// The files that a program reads and writes, so that it writes none over what it reads, and none twice: a forgotten
// word on a command line must not cost a scene.
//
//   FilesInUse files;
//   files.reads("the scene that is run", scene);
//   files.writes("--summary", summary);
//   files.writes_into("--csv", folder, "particles.*\\.csv");
//
// One file under two names (links, "./a" for "a", hard links) is known for one.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "mpm/math/error.hpp"

namespace mpm {

/// A file to be written is one that is read, or that is written twice. what() names the option and the file.
class FileInUse : public Error {
 public:
  using Error::Error;
};

/// Call reads() for all before writes(). An empty path is no file.
class FilesInUse {
 public:
  /// `what`: the file, as the user knows it.
  void reads(const std::string& what, const std::string& path);
  /// `option`: what names the file to be written. @throws FileInUse
  void writes(const std::string& option, const std::string& path);
  /// Files of a folder whose names match the regular expression (ECMAScript) as a whole. @throws FileInUse
  void writes_into(const std::string& option, const std::string& folder, const std::string& names);

 private:
  struct Read {
    std::string what, file;  ///< behind links
  };
  struct Folder {
    std::string option, folder, names;
  };
  std::vector<Read> read_;
  std::map<std::string, std::vector<std::string>> written_;  ///< files by option
  std::vector<Folder> folders_;
};

}  // namespace mpm
