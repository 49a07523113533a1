//! Double-exponential grids (H. Takahasi, M. Mori, Publ. RIMS 9 (1974) 721) that know the distance of
//! each node to both ends.
