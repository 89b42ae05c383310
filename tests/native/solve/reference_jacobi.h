// SPDX-License-Identifier: GPL-3.0-or-later
// Eq. 3 and 4 in double precision, each quantity as its definition reads.
#pragma once

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "solve/solver.h"

namespace antiradiance::test {

class ReferenceJacobi {
public:
    using dvec3 = glm::dvec3;

    explicit ReferenceJacobi(const TransportProblem& problem)
        : p_(problem), t_(problem.tree), phi_(problem.links.segments.size(), dvec3(0)) {
        radiance.assign(t_.size(), dvec3(0));
        irradiance.assign(t_.size(), dvec3(0));
        for (const NodeId leaf : t_.leaves)
            radiance[at(leaf)] = dvec3(p_.source[at(leaf)]);
        pull();
    }

    void pass() {
        const LinkSet& set = p_.links;
        dvec3 brightest(0);
        for (const NodeId leaf : t_.leaves)
            brightest = glm::max(brightest, radiance[at(leaf)]);
        std::vector<dvec3> next(phi_.size());
        for (int b = 0; b < set.bins.count(); ++b) {
            const std::map<NodeId, dvec3> own = own_antiradiance(b);
            const dvec3 axis(set.bins.axis(b));
            for (std::uint32_t s = set.bin_segments[at(b)]; s < set.bin_segments[at(b) + 1]; ++s) {
                dvec3 sum(0);
                for (std::uint32_t l = set.segments[s].begin; l < set.segments[s].end; ++l) {
                    const Link& link = set.links[l];
                    const dvec3 carried =
                        link.form_factor < 0
                            ? -glm::clamp(antiradiance(own, link.source), dvec3(0), brightest)
                            : sent(link.source, axis);
                    sum += std::abs(static_cast<double>(link.form_factor)) * carried;
                }
                next[s] = glm::pi<double>() * sum;
            }
        }
        phi_ = next;
        reflect();
    }

    std::vector<dvec3> radiance;    // #nodes
    std::vector<dvec3> irradiance;  // #nodes, at leaves
    double residual = 0;

private:
    static std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }
    [[nodiscard]] bool is_patch(NodeId n) const { return n != kNone && !t_.is_cluster(n); }

    template <class Visit>
    void for_children(NodeId n, Visit&& visit) const {
        for (NodeId c = n + 1; c < t_.subtree_end[at(n)]; c = t_.subtree_end[at(c)])
            visit(c);
    }

    void pull() {
        for (auto n = static_cast<NodeId>(t_.size()); n-- > 0;) {
            if (t_.is_leaf(n)) continue;
            dvec3 sum(0);
            for_children(
                n, [&](NodeId c) { sum += static_cast<double>(t_.area[at(c)]) * radiance[at(c)]; });
            radiance[at(n)] = sum / static_cast<double>(t_.area[at(n)]);
        }
    }

    [[nodiscard]] std::map<NodeId, dvec3> own_antiradiance(int bin) const {
        std::map<NodeId, dvec3> own;
        for (std::uint32_t s = p_.links.bin_segments[at(bin)];
             s < p_.links.bin_segments[at(bin) + 1]; ++s) {
            const Segment& segment = p_.links.segments[s];
            own[segment.receiver] = phi_[s] * static_cast<double>(segment.inv_c);
        }
        return own;
    }
    static dvec3 value(const std::map<NodeId, dvec3>& own, NodeId n) {
        const auto found = own.find(n);
        return found == own.end() ? dvec3(0) : found->second;
    }
    [[nodiscard]] dvec3 below(const std::map<NodeId, dvec3>& own, NodeId n) const {
        dvec3 sum(0);
        for_children(n, [&](NodeId c) {
            sum += static_cast<double>(t_.area[at(c)]) * (value(own, c) + below(own, c));
        });
        return sum / static_cast<double>(t_.area[at(n)]);
    }
    [[nodiscard]] dvec3 antiradiance(const std::map<NodeId, dvec3>& own, NodeId n) const {
        dvec3 sum = below(own, n);
        for (NodeId a = n; is_patch(a); a = t_.parent[at(a)])
            sum += value(own, a);
        return sum;
    }

    // max(0, cos) to second order in the angle between two unit vectors.
    static double cosine(const dvec3& n, const dvec3& d) {
        const double c = glm::dot(n, d);
        return 0.25 + c / 2 + 15.0 / 32.0 * (c * c - 1.0 / 3.0);
    }
    [[nodiscard]] dvec3 sent(NodeId source, const dvec3& axis) const {
        if (!t_.is_cluster(source)) return radiance[at(source)];
        const bool narrow = t_.cone_cosine[at(source)] > 0.9F;
        dvec3 sum(0);
        for (std::size_t s = 0; s < t_.surfaces.size(); ++s) {
            const NodeId n = t_.surface_node[s];
            if (t_.surfaces[s].lamp != kNone || n < source || n >= t_.subtree_end[at(source)]) {
                continue;
            }
            const dvec3 normal(t_.normal[at(n)]);
            sum += static_cast<double>(t_.area[at(n)]) * radiance[at(n)] *
                   (narrow ? glm::dot(normal, axis) : cosine(normal, axis));
        }
        return glm::max(sum, dvec3(0));
    }

    void reflect() {
        std::vector<dvec3> gathered(t_.size(), dvec3(0));
        for (std::size_t s = 0; s < phi_.size(); ++s) {
            const NodeId r = p_.links.segments[s].receiver;
            if (is_patch(r)) gathered[at(r)] += phi_[s];
        }
        for (std::size_t s = 0; s < t_.surfaces.size(); ++s) {
            if (t_.surfaces[s].lamp == kNone) {
                gathered[at(t_.surface_node[s])] += from_clusters(t_.surface_node[s]);
            }
        }
        double change = 0, gained = 0;
        for (const NodeId leaf : t_.leaves) {
            dvec3 e(0);
            for (NodeId n = leaf; is_patch(n); n = t_.parent[at(n)])
                e += gathered[at(n)];
            e *= static_cast<double>(p_.row_scale[at(leaf)]);
            irradiance[at(leaf)] = glm::max(e, dvec3(0));
            const dvec3 next = glm::max(
                dvec3(p_.source[at(leaf)]) + dvec3(p_.albedo[at(leaf)]) / glm::pi<double>() * e,
                dvec3(0));
            for (int c = 0; c < 3; ++c) {
                change = std::max(change, std::abs(next[c] - radiance[at(leaf)][c]));
                gained = std::max(gained,
                                  std::abs(next[c] - static_cast<double>(p_.source[at(leaf)][c])));
            }
            radiance[at(leaf)] = next;
        }
        residual = gained > 0 ? change / gained : 0;
        pull();
    }
    [[nodiscard]] dvec3 from_clusters(NodeId surface) const {
        dvec3 sum(0);
        for (int b = 0; b < p_.links.bins.count(); ++b) {
            const dvec3 to_source = -dvec3(p_.links.bins.axis(b));
            for (std::uint32_t s = p_.links.bin_segments[at(b)];
                 s < p_.links.bin_segments[at(b) + 1]; ++s) {
                const NodeId r = p_.links.segments[s].receiver;
                if (!t_.is_cluster(r) || surface < r || surface >= t_.subtree_end[at(r)]) continue;
                sum += phi_[s] * cosine(dvec3(t_.normal[at(surface)]), to_source);
            }
        }
        return glm::max(sum, dvec3(0));
    }

    const TransportProblem p_;
    const PatchTree& t_;
    std::vector<dvec3> phi_;  // #segments
};

}  // namespace antiradiance::test
