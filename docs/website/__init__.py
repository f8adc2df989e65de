"""What docs/build.py makes the site from: pages, notebooks with outputs, the interface, the algorithms line by line."""
