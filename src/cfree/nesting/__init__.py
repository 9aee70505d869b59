"""Nesting: no-fit polygons, inner-fit regions, and layouts of parts on sheets, checked, compacted and placed."""

from typing import TYPE_CHECKING

from cfree.lazy import lazy_names

if TYPE_CHECKING:
    from cfree.nesting.checking import Overlap as Overlap
    from cfree.nesting.checking import overlaps as overlaps
    from cfree.nesting.compaction import Compacted as Compacted
    from cfree.nesting.compaction import PartMotion as PartMotion
    from cfree.nesting.compaction import compact as compact
    from cfree.nesting.freeing import can_be_cut_free as can_be_cut_free
    from cfree.nesting.freeing import way_out as way_out
    from cfree.nesting.layout import Nesting as Nesting
    from cfree.nesting.layout import Part as Part
    from cfree.nesting.layout import Placed as Placed
    from cfree.nesting.nofit import NFP as NFP
    from cfree.nesting.nofit import InnerFit as InnerFit
    from cfree.nesting.nofit import inner_fit as inner_fit
    from cfree.nesting.nofit import nfp as nfp
    from cfree.nesting.placement import place as place
    from cfree.nesting.reading import load_nesting as load_nesting
    from cfree.nesting.rotational import RotationalNFP as RotationalNFP
    from cfree.nesting.rotational import TopologyChange as TopologyChange
    from cfree.nesting.rounded import ContactEdge as ContactEdge
    from cfree.nesting.rounded import RoundedFit as RoundedFit
    from cfree.nesting.writing import save_nesting as save_nesting

__getattr__, __dir__, __all__ = lazy_names(
    __name__,
    {
        "nofit": "InnerFit NFP inner_fit nfp",
        "rounded": "ContactEdge RoundedFit",
        "rotational": "RotationalNFP TopologyChange",
        "layout": "Nesting Part Placed",
        "checking": "Overlap overlaps",
        "compaction": "Compacted PartMotion compact",
        "freeing": "can_be_cut_free way_out",
        "placement": "place",
        "reading": "load_nesting",
        "writing": "save_nesting",
    },
)
