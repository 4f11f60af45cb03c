// The elements of an XML text, found without recursion: how deep they lie in each other, before a parser that calls
// itself for each of them reads the text, and where they begin and end.
#pragma once

#include <string>
#include <vector>

namespace mpm {

struct XmlElement {
  std::string name;
  std::string attributes;          ///< as they are written, with blanks around
  int parent = -1;                 ///< its place in the list; -1 of one that is in no other
  int line = 0;                    ///< on which it begins, from 1
  std::size_t begin = 0, end = 0;  ///< range of its text, tags and all
};

/// All elements in the order in which they begin. What is not well-formed is left to the parser: an element without end
/// reaches to that of the text, an end without beginning counts for nothing. Comments, CDATA sections, processing
/// instructions and declarations are passed over. @throws RigidError with the line of one that lies deeper than
/// `deepest`
std::vector<XmlElement> outline_of_xml(const std::string& text, int deepest);

/// The value of an attribute, without its quotes; empty where there is none of this name.
std::string attribute_of(const XmlElement& element, const std::string& name);

/// Refuses XML with elements that lie deeper than `deepest`, without keeping any. @throws RigidError with the line
void check_depth_of_xml(const std::string& text, int deepest);

/// Refuses JSON with more than `deepest` brackets open in each other. @throws RigidError with the line
void check_depth_of_json(const std::string& text, int deepest);

}  // namespace mpm
