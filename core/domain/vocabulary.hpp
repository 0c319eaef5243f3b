#pragma once
// The fields that plugins share. A plugin is free to declare others of its own.

#include "core/domain/field.hpp"

namespace beadwork::field {

// Lines: what one loop fetches together lies together.
inline const Field element_id{"id", On::elements, Type::index, "1", "Stable number of the element", ""};
inline const Field position{"position", On::elements, Type::vec3, "m", "Centre of the element", "pose"};
inline const Field orientation{
    "orientation", On::elements, Type::quat, "1", "Unit quaternion (w, x, y, z), body to world", "pose"};
inline const Field velocity{"velocity", On::elements, Type::vec3, "m/s", "Velocity of the centre", "motion"};
inline const Field spin{"spin", On::elements, Type::vec3, "1/s", "Angular velocity, world axes", "motion"};
inline const Field force{"force", On::elements, Type::vec3, "N", "Sum of the forces on the element", "load"};
inline const Field torque{"torque", On::elements, Type::vec3, "N.m", "Sum of the torques about the centre", "load"};
inline const Field radius{"radius", On::elements, Type::real, "m", "Radius of the element", ""};
inline const Field mass{"mass", On::elements, Type::real, "kg", "Mass of the element", "inertia"};
inline const Field inertia{
    "inertia", On::elements, Type::real, "kg.m2", "Moment of inertia about any axis through the centre", "inertia"};

// What a bond law can say of a bond, if somebody asks.
inline const Field axial_force{"axial-force", On::bonds, Type::real, "N", "Axial force, tension positive", ""};
inline const Field bending_moment{
    "bending-moment", On::bonds, Type::real, "N.m", "Larger bending moment of the two ends", ""};
inline const Field twisting_moment{"twisting-moment", On::bonds, Type::real, "N.m", "Twisting moment", ""};
inline const Field section_radius{"section-radius", On::bonds, Type::real, "m", "Radius of the circular section", ""};
inline const Field rest_length{
    "rest-length", On::bonds, Type::real, "m", "Distance of the centres when the bond was made", ""};
inline const Field utilisation{"utilisation", On::bonds, Type::real, "1", "Failure criterion over its threshold", ""};
inline const Field damage{"damage", On::bonds, Type::real, "1", "0 undamaged, 1 failed", ""};

// Of pairs that may touch.
inline const Field contact_length{
    "contact-length",
    On::bonds,
    Type::real,
    "m",
    "Distance of the centres below which two elements touch: the sum of their radii, or less where a bond broke",
    ""};
inline const Field facet{"facet", On::bonds, Type::real, "1", "Number of the part of the wall", ""};
inline const Field broke_at{"broke-at", On::bonds, Type::real, "m", "Distance of the centres when the bond broke", ""};
inline const Field searched_at{
    "searched-at", On::elements, Type::vec3, "m", "Place when pairs that may touch were last looked for", ""};

// What a criterion finds over its threshold.
inline const Field element_utilisation{
    "utilisation", On::elements, Type::real, "1", "Failure criterion over its threshold", ""};

// Sums that bond laws offer of each element.
inline const Field virial_sum{
    "virial-sum", On::elements, Type::sym3, "N.m", "Sum of sym(r x f) over the element's bonds", ""};
inline const Field virial_trace_sum{
    "virial-trace-sum", On::elements, Type::real, "N.m", "Sum of r.f over the element's bonds", ""};

}  // namespace beadwork::field
