"""The process behind a node."""

import xmlrpc.client

import rosgraph
import rosnode
import rospy


def pid_of(node):
    me = rospy.get_name()
    uri = rosnode.get_api_uri(rosgraph.Master(me), node, skip_cache=True)
    return xmlrpc.client.ServerProxy(uri).getPid(me)[2]
