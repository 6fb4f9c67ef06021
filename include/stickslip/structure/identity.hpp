// Texts by which structures with a sliding interface are compared: in files of ensembles.
#pragma once

#include <string>

#include "stickslip/base/requirements.hpp"

namespace stickslip {

class EquipmentOnFloor;
class IsolatedStructure;
struct FlexibleSlope;

/// Everything that the motion of a structure with a sliding interface depends on, as a JSON object.
std::string identity(const IsolatedStructure& system);
std::string identity(const EquipmentOnFloor& system);
std::string identity(const FlexibleSlope& slope);

}  // namespace stickslip
