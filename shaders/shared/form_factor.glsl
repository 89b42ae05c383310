// SPDX-License-Identifier: GPL-3.0-or-later
// Form factor from a polygon to a point, as native/links/form_factor.cpp has it (Lambert 1760;
// Baum, Rushmeier & Winget 1989), without arrays: edges are clipped as they come.

const float kPi = 3.14159265358979;
const float kTiny = 1e-30;  // in place of a division by 0

// atan(t) / t for t in [0, 1] from t2 = t^2 (Abramowitz & Stegun 1964, 4.4.49): drivers' atan() are
// not all this accurate.
float arctangent_share(float t2) {
    float high = ((0.0028662257 * t2 - 0.0161657367) * t2 + 0.0429096138) * t2;
    float middle = ((high - 0.0752896400) * t2 + 0.1065626393) * t2;
    return ((((middle - 0.1420889944) * t2 + 0.1999355085) * t2) - 0.3333314528) * t2 + 1.0;
}

// Angle that an edge spans times the component along `normal` of the unit vector across it; corners
// relative to the point. An edge of no length gives 0.
float edge_part(vec3 from, vec3 to, vec3 normal) {
    vec3 across = cross(from, to);
    float sine = length(across);
    float cosine = dot(from, to);
    float size = abs(cosine);
    float t = min(sine, size) / (max(sine, size) + kTiny);
    float octant = t * arctangent_share(t * t);
    float quadrant = sine < size ? octant : kPi / 2.0 - octant;
    float angle = cosine < 0.0 ? kPi - quadrant : quadrant;
    return dot(across, normal) * (angle / (sine + kTiny));
}

// Positive where the polygon's front (counter-clockwise) faces the point, negative where its back
// does. Corners are relative to the point.
float point_form_factor(vec3 normal, vec3 corners[4]) {
    float sum = 0.0;
    vec3 rise = vec3(0.0);  // where the outline comes up through the horizon
    vec3 set = vec3(0.0);   // and where it goes down
    vec3 from = corners[3];
    float from_height = dot(from, normal);
    for (int i = 0; i < 4; ++i) {
        vec3 to = corners[i];
        float to_height = dot(to, normal);
        if (from_height > 0.0 || to_height > 0.0) {
            vec3 crossing = from + (to - from) * (from_height / (from_height - to_height));
            if (from_height <= 0.0) rise = crossing;
            if (to_height <= 0.0) set = crossing;
            sum += edge_part(from_height > 0.0 ? from : rise, to_height > 0.0 ? to : set, normal);
        }
        from = to;
        from_height = to_height;
    }
    sum += edge_part(set, rise, normal);  // along the horizon
    // Corners that run counter-clockwise as seen from their front run clockwise about the point.
    return -sum / (2.0 * kPi);
}
