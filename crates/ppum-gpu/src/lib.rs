//! Draws fields exactly at every pixel on graphics cards.
