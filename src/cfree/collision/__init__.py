"""Is a pose free, is a motion free, how far is it to the obstacles?"""
