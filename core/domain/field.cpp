#include "core/domain/field.hpp"

namespace beadwork {

const char* type_name(Type type) {
  switch (type) {
    case Type::real: return "real";
    case Type::vec3: return "vector";
    case Type::quat: return "quaternion";
    case Type::sym3: return "symmetric tensor";
    case Type::index: return "index";
    case Type::state: return "state";
  }
  return "";
}

const char* place_name(On on) {
  switch (on) {
    case On::elements: return "elements";
    case On::bonds: return "bonds";
    case On::scene: return "scene";
  }
  return "";
}

}  // namespace beadwork
