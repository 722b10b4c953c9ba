"""The firmware of the rig's board: an Arduino sketch and how its generated part is made."""
