"""Contacts of a robot and an obstacle: their types, orientations and surfaces (the paper, sections 1 to 3).

`features`, `arcs` and `torus` are for shapes with circular arcs, the paper's future work.
"""

from typing import TYPE_CHECKING

from cfree.lazy import lazy_names

if TYPE_CHECKING:
    from cfree.contact.arcs import ArcArc as ArcArc
    from cfree.contact.arcs import ArcArcSurface as ArcArcSurface
    from cfree.contact.arcs import ArcEdge as ArcEdge
    from cfree.contact.arcs import EdgeArc as EdgeArc
    from cfree.contact.arcs import OffsetSurface as OffsetSurface
    from cfree.contact.arcs import arc_contacts as arc_contacts
    from cfree.contact.arcs import arc_curves as arc_curves
    from cfree.contact.arcs import arc_range as arc_range
    from cfree.contact.arcs import arc_surface as arc_surface
    from cfree.contact.contact import AngleRange as AngleRange
    from cfree.contact.contact import EdgeEdge as EdgeEdge
    from cfree.contact.contact import EdgeVertex as EdgeVertex
    from cfree.contact.contact import VertexEdge as VertexEdge
    from cfree.contact.contact import VertexVertex as VertexVertex
    from cfree.contact.contact import angle_range as angle_range
    from cfree.contact.contact import contact_curves as contact_curves
    from cfree.contact.contact import contacts as contacts
    from cfree.contact.contact import edge_edge_range as edge_edge_range
    from cfree.contact.definitions import contact_features as contact_features
    from cfree.contact.definitions import is_contact as is_contact
    from cfree.contact.definitions import is_forbidden as is_forbidden
    from cfree.contact.definitions import is_pseudo_contact as is_pseudo_contact
    from cfree.contact.features import ArcFeature as ArcFeature
    from cfree.contact.features import EdgeFeature as EdgeFeature
    from cfree.contact.features import ShapeFeatures as ShapeFeatures
    from cfree.contact.features import shape_features as shape_features
    from cfree.contact.surface import EdgeEdgeSegment as EdgeEdgeSegment
    from cfree.contact.surface import Helix as Helix
    from cfree.contact.surface import Surface as Surface
    from cfree.contact.surface import contact_helix as contact_helix
    from cfree.contact.surface import contact_segment as contact_segment
    from cfree.contact.surface import contact_surface as contact_surface
    from cfree.contact.surface import edge_edge_surface as edge_edge_surface
    from cfree.contact.surface import helix_through as helix_through
    from cfree.contact.surface import rotation_about as rotation_about
    from cfree.contact.surface import rotation_of_combination as rotation_of_combination
    from cfree.contact.torus import Tiling as Tiling
    from cfree.contact.torus import tiling as tiling

__getattr__, __dir__, __all__ = lazy_names(
    __name__,
    {
        "arcs": "ArcArc ArcArcSurface ArcEdge EdgeArc OffsetSurface arc_contacts arc_curves arc_range arc_surface",
        "contact": "AngleRange EdgeEdge EdgeVertex VertexEdge "
        "VertexVertex angle_range contact_curves contacts edge_edge_range",
        "definitions": "contact_features is_contact is_forbidden is_pseudo_contact",
        "features": "ArcFeature EdgeFeature ShapeFeatures shape_features",
        "surface": "EdgeEdgeSegment Helix Surface contact_helix "
        "contact_segment contact_surface edge_edge_surface helix_through rotation_about rotation_of_combination",
        "torus": "Tiling tiling",
    },
)
